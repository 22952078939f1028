/* SPDX-License-Identifier: MIT */
/* The materials, attitudes and scenes of a kit, as tables. This file decides what is tested; mesh.c
   makes facets from a row. A change here requires a new LRCS_HOST_KIT_VERSION. */
#include "host/kit/vectors.h"

#include <stddef.h>

const lrcsi_vectors_material lrcsi_vectors_materials[] = {
    {"white", {0.0, 0.25, 0.3, 0.0}, 0, {235, 235, 230}, 'w'},
    {"power", {0.0, 0.2, 0.3, 2.5}, 0, {170, 190, 220}, 'p'},
    {"gloss", {4.0, 0.0, 0.1, 0.0}, 0, {240, 220, 120}, 'g'},
    {"reference", {1.0, 0.25, 0.2, 0.5}, 0, {200, 200, 200}, 'r'},
    {"metal", {0.1, 0.15, 0.4, 0.5}, 0, {150, 150, 160}, 'm'},
    {"cells", {0.6, 0.016, 0.1, 0.5}, 0, {30, 40, 110}, 'c'},
    {"foil", {0.62, 0.05, 0.3, 0.3}, 0, {220, 170, 60}, 'f'},
    {"ochre", {0.3, 0.1, 0.25, 1.5}, 0, {200, 120, 50}, 'o'},
    {"blue", {0.05, 0.3, 0.35, 0.8}, 0, {60, 90, 220}, 'b'},
    {"needle", {30.0, 0.02, 0.02, 1.0}, 0, {250, 250, 160}, 'n'},
    {"both-sides", {0.02, 0.25, 0.4, 0.2}, 1, {210, 230, 210}, 't'},
    {"dark", {0.0, 0.005, 0.3, 0.0}, 0, {40, 40, 40}, 'k'},
    {NULL, {0.0, 0.0, 0.0, 0.0}, 0, {0, 0, 0}, '\0'}};

#define TILTS   LRCSI_VECTORS_TILTS
#define OBLIQUE LRCSI_VECTORS_OBLIQUE
#define EDGES   LRCSI_VECTORS_EDGES

/* tNN: rotated about y by some NN deg; xNN: about x. */
const lrcsi_vectors_attitude lrcsi_vectors_attitudes[] = {
    {"nose", TILTS | OBLIQUE | EDGES, {1, 0, 0, 0}},
    {"t05", TILTS, {23, 0, 1, 0}},
    {"t10", TILTS, {23, 0, 2, 0}},
    {"t20", TILTS, {17, 0, 3, 0}},
    {"t40", TILTS, {11, 0, 4, 0}},
    {"t60", TILTS, {7, 0, 4, 0}},
    {"t80", TILTS, {6, 0, 5, 0}},
    {"t87", TILTS, {20, 0, 19, 0}},
    {"x30", TILTS, {15, 4, 0, 0}},
    {"behind", TILTS, {1, 0, 2, 0}},
    {"a", OBLIQUE, {9, 2, -1, 3}},
    {"b", OBLIQUE, {5, -3, 2, 1}},
    {"c", OBLIQUE, {4, 1, 3, -2}},
    {"d", OBLIQUE, {3, -4, 1, 2}},
    {"e", OBLIQUE, {1, 3, -2, 5}},
    {"f", OBLIQUE, {2, 5, 3, -1}},
    {"g", OBLIQUE, {7, -1, -5, 2}},
    {"h", OBLIQUE, {6, 5, 1, -3}},
    {"roll", EDGES, {1, 0, 0, 1}},
    {"front", EDGES, {1, 1, 0, 0}},
    {"side", EDGES, {1, 0, 1, 0}},
    {"below", EDGES, {0, 1, 0, 0}},
    {"thirds", EDGES, {1, 1, 1, 1}},
    {NULL, 0, {0, 0, 0, 0}}};

#define UP                                                                                         \
    {                                                                                              \
        0.0, 0.0, 0.0                                                                              \
    }
#define HERE  UP
#define PLATE LRCSI_VECTORS_PLATE
#define BOX   LRCSI_VECTORS_BOX
#define ROUND LRCSI_VECTORS_ROUND
#define BALL  LRCSI_VECTORS_BALL
#define QUILT LRCSI_VECTORS_QUILT
#define FAN   LRCSI_VECTORS_FAN
#define AWAY                                                                                       \
    {                                                                                              \
        16384, -8192, 4096                                                                         \
    }

/* The items of a scene. */
#define ITEMS(...) ((const lrcsi_vectors_item[]){__VA_ARGS__, {.kind = LRCSI_VECTORS_NONE}})

/* The bus and the arrays shadow each other; the shadows have closed forms. */
#define WINGS                                                                                      \
    ITEMS({BOX, 0, {1, 1, 1}, HERE, UP, "frmobw"}, {PLATE, 0, {2, 1, 0}, {1.625, 0, 0}, UP, "c"},  \
          {PLATE, 0, {2, 1, 0}, {-1.625, 0, 0}, UP, "t"})

/* A scene of two surfaces 2^-K m apart, a bright one below half of a dark one. */
#define CLOSE_SURFACES(K)                                                                          \
    {                                                                                              \
        "skins-" #K, 5, OBLIQUE, 1.0, HERE,                                                        \
            ITEMS({PLATE, 0, {2, 2, 0}, {0, 0, -1.0 / (double)(UINT64_C(1) << (K))}, UP, "r"},     \
                  {PLATE, 0, {1, 2, 0}, {0.5, 0, 0}, UP, "k"},                                     \
                  {BOX, 0, {0.25, 0.25, 0.25}, {2, 0, 4}, UP, "o"},                                \
                  {BOX, 0, {0.25, 0.25, 0.25}, {-2, 0, -4}, UP, "b"}),                             \
            "two surfaces 2^-" #K " m apart in a scene 8 m deep"                                   \
    }

const lrcsi_vectors_scene lrcsi_vectors_scenes[] = {
    {"plate-white", 1, TILTS, 1.0, HERE, ITEMS({PLATE, 0, {2, 1, 0}, HERE, UP, "w"}),
     "a plate of 2 x 1 m that scatters the same way everywhere: 4 pi B S cos^2"},
    {"plate-power", 1, TILTS, 1.0, HERE, ITEMS({PLATE, 0, {2, 1, 0}, HERE, UP, "p"}),
     "the diffuse term with a power of the cosine"},
    {"plate-gloss", 1, TILTS, 1.0, HERE, ITEMS({PLATE, 0, {2, 1, 0}, HERE, UP, "g"}),
     "the glint term alone"},
    {"plate-turned", 1, OBLIQUE, 1.0, HERE,
     ITEMS({PLATE, 0, {2, 1, 0}, {0.5, 0.25, 0}, {20, 50, 10}, "r"}),
     "both terms, on a plate that stands along no axis"},
    {"box", 2, OBLIQUE | EDGES, 1.0, HERE, ITEMS({BOX, 0, {2, 1.5, 1}, HERE, UP, "rgomwb"}),
     "six faces, six materials: frames, quaternions, handedness"},
    {"brick", 2, OBLIQUE, 1.0, HERE,
     ITEMS({BOX, 0, {2, 1.5, 1}, {0.25, 0, 1}, {20, 30, 40}, "bwomgr"}),
     "the same, turned in the body frame"},
    {"drum", 2, OBLIQUE | EDGES, 1.0, HERE, ITEMS({ROUND, 24, {0.5, 0.5, 2}, HERE, UP, "rmw"}),
     "a prism of 24 sides: many facets, one normal each"},
    {"cone", 2, OBLIQUE | EDGES, 1.0, HERE, ITEMS({ROUND, 24, {0.5, 0, 1.5}, HERE, UP, "or"}),
     "a cone of 24 sides with its base"},
    {"ball", 2, OBLIQUE, 1.0, HERE, ITEMS({BALL, 24, {1, 0, 0}, HERE, UP, "r"}),
     "a sphere of 24 meridians"},
    {"needle-drum", 2, OBLIQUE | EDGES, 1.0, HERE, ITEMS({ROUND, 48, {0.5, 0.5, 2}, HERE, UP, "n"}),
     "glints ten times narrower than the turn from facet to facet"},
    {"bracket", 3, TILTS | OBLIQUE, 1.0, HERE,
     ITEMS({PLATE, 0, {1, 1, 0}, HERE, UP, "r"},
           {PLATE, 0, {1, 1, 0}, {0.5, 0, 0.5}, {0, -90, 0}, "b"}),
     "an L: the wall shadows 1 - tan of the floor"},
    {"wings", 3, TILTS | OBLIQUE, 1.0, HERE, WINGS,
     "a cube between two arrays, one of them two-sided"},
    {"comb", 3, OBLIQUE, 1.0, HERE,
     ITEMS({PLATE, 0, {4, 2, 0}, HERE, UP, "r"},
           {BOX, 0, {0.0625, 2, 0.5}, {-1.5, 0, 0.25}, UP, "o"},
           {BOX, 0, {0.0625, 2, 0.5}, {-1, 0, 0.25}, UP, "m"},
           {BOX, 0, {0.0625, 2, 0.5}, {-0.5, 0, 0.25}, UP, "o"},
           {BOX, 0, {0.0625, 2, 0.5}, {0, 0, 0.25}, UP, "m"},
           {BOX, 0, {0.0625, 2, 0.5}, {0.5, 0, 0.25}, UP, "o"},
           {BOX, 0, {0.0625, 2, 0.5}, {1, 0, 0.25}, UP, "m"},
           {BOX, 0, {0.0625, 2, 0.5}, {1.5, 0, 0.25}, UP, "o"}),
     "fins on a plate, whose feet lie in its plane, back to front"},
    {"tray", 3, OBLIQUE, 1.0, HERE,
     ITEMS({BOX, 0, {2, 1, 0.75}, HERE, UP, "rbom-w"},
           {BALL, 12, {0.25, 0, 0}, {0.25, 0.125, 0}, UP, "f"}),
     "an open box: its inner sides are the backs of its walls, which hide but do not reflect"},
    {"dish", 3, OBLIQUE | EDGES, 1.0, HERE,
     ITEMS({ROUND, 24, {0, 1, 0.5}, HERE, UP, "t--"},
           {BALL, 12, {0.125, 0, 0}, {0, 0, 0.5}, UP, "m"},
           {PLATE, 0, {1.5, 1.5, 0}, {0.25, 0.125, -0.375}, UP, "f"}),
     "an open cone that reflects from both sides, over a plate"},
    {"gate", 3, OBLIQUE, 1.0, HERE,
     ITEMS({BOX, 0, {0.25, 0.25, 2}, {-1, 0, 0}, UP, "r"},
           {BOX, 0, {0.25, 0.25, 2}, {1, 0, 0}, UP, "o"},
           {BOX, 0, {2.25, 0.25, 0.25}, {0, 0, 1.125}, UP, "b"},
           {ROUND, 16, {0.375, 0.25, 1.5}, {0.25, 1, 0}, {35, 0, 0}, "gmw"}),
     "a frame before a frustum"},
    {"satellite", 4, OBLIQUE, 1.0, HERE,
     ITEMS({BOX, 0, {1.25, 1.25, 1.75}, HERE, UP, "f"},
           {PLATE, 0, {1, 1.5, 0}, {0, 0.640625, 0}, {-90, 0, 0}, "w"},
           {BOX, 0, {0.5, 0.0625, 0.0625}, {0.875, 0, 0}, UP, "m"},
           {BOX, 0, {0.5, 0.0625, 0.0625}, {-0.875, 0, 0}, UP, "m"},
           {BOX, 0, {2.5, 1.125, 0.03125}, {2.375, 0, 0}, {20, 0, 0}, "w"},
           {BOX, 0, {2.5, 1.125, 0.03125}, {-2.375, 0, 0}, {20, 0, 0}, "w"},
           {PLATE, 0, {2.375, 1, 0}, {2.375, -0.0068, 0.0188}, {20, 0, 0}, "c"},
           {PLATE, 0, {2.375, 1, 0}, {-2.375, -0.0068, 0.0188}, {20, 0, 0}, "c"},
           {ROUND, 48, {0, 0.5, 0.25}, {0, 0, 1.0625}, UP, "t--"},
           {ROUND, 32, {0.1875, 0.0625, 0.3125}, {0, 0, -1.03125}, UP, "m"}),
     "a bus with arrays, a dish and a nozzle; the cells lie 4 mm above the wings"},
    {"spinner", 4, OBLIQUE, 1.0, HERE,
     ITEMS({ROUND, 64, {1, 1, 1.5}, HERE, UP, "cfm"},
           {ROUND, 32, {0.25, 0.125, 0.5}, {0, 0, -1}, UP, "m"},
           {ROUND, 32, {0, 0.75, 0.375}, {0, 0, 1.1875}, UP, "t--"},
           {BOX, 0, {0.0625, 0.0625, 1}, {0.5, 0.25, 1.25}, UP, "w"},
           {BOX, 0, {3, 0.03125, 0.03125}, {2, 0, 0.5}, {0, 10, 20}, "b"}),
     "a drum of cells with a dish, a nozzle and booms"},
    {"station", 4, OBLIQUE, 1.0, HERE,
     ITEMS({ROUND, 32, {0.75, 0.75, 4}, HERE, {0, 90, 0}, "wmm"},
           {ROUND, 32, {0.5, 0.5, 2}, {0.5, 0, 1.5}, UP, "fom"},
           {BALL, 16, {0.625, 0, 0}, {-2.25, 0, 0}, UP, "m"},
           {BOX, 0, {0.125, 6, 0.125}, {1, 0, -0.875}, UP, "m"},
           {PLATE, 0, {1, 2, 0}, {1, 2, -1}, {0, 40, 0}, "c"},
           {PLATE, 0, {1, 2, 0}, {1, -2, -1}, {0, 40, 0}, "c"},
           {PLATE, 0, {1, 2, 0}, {1, 2, -1.0078125}, {0, 220, 0}, "w"},
           {PLATE, 0, {1, 2, 0}, {1, -2, -1.0078125}, {0, 220, 0}, "w"}),
     "modules and arrays that shadow each other"},
    {"quilt", 4, TILTS | OBLIQUE, 1.0, HERE,
     ITEMS({QUILT, 16, {2, 2, 0.0078125}, HERE, UP, "n"},
           {BALL, 16, {0.25, 0, 0}, {0.25, 0, 0.5}, UP, "o"}),
     "512 facets of crumpled foil with narrow glints below a ball"},
    {"slivers", 5, OBLIQUE, 1.0, HERE,
     ITEMS({FAN, 720, {1, 0, 0}, HERE, UP, "r"},
           {BOX, 0, {0.125, 3, 0.125}, {0.25, 0, 0.5}, UP, "m"}),
     "720 slivers to a disc, below a bar"},
    {"two-faced", 5, TILTS | OBLIQUE, 1.0, HERE,
     ITEMS({PLATE, 0, {2, 1, 0}, HERE, UP, "r"}, {PLATE, 0, {2, 1, 0}, HERE, {180, 0, 0}, "b"}),
     "two surfaces in one plane, back to back: the one that faces the laser is seen, whatever "
     "rounding says"},
    {"twins", 5, OBLIQUE, 1.0, HERE,
     ITEMS({PLATE, 0, {2, 1, 0}, HERE, UP, "r"}, {PLATE, 0, {2, 1, 0}, HERE, UP, "k"}),
     "the same plate twice, in two materials: the first one counts"},
    CLOSE_SURFACES(10),
    CLOSE_SURFACES(14),
    CLOSE_SURFACES(18),
    CLOSE_SURFACES(22),
    CLOSE_SURFACES(40),
    {"cross", 5, OBLIQUE | EDGES, 1.0, HERE,
     ITEMS({PLATE, 0, {2, 1, 0}, HERE, UP, "r"}, {PLATE, 0, {2, 1, 0}, HERE, {0, 90, 0}, "t"},
           {PLATE, 0, {2, 1, 0}, HERE, {40, 0, 90}, "o"}),
     "plates that pierce each other"},
    {"edge-on", 5, EDGES, 1.0, HERE,
     ITEMS({BOX, 0, {1, 1, 1}, HERE, UP, "rgombw"}, {PLATE, 0, {2, 2, 0}, {0, 0, 0.5}, UP, "f"},
           {PLATE, 0, {2, 2, 0}, {0.5, 0, 0}, {0, -90, 0}, "c"}),
     "plates exactly in the faces of a box, from directions exactly in their planes"},
    {"sunk", 5, OBLIQUE, 1.0, HERE,
     ITEMS({PLATE, 0, {3, 2, 0}, HERE, {10, 20, 0}, "r"},
           {BALL, 16, {0.75, 0, 0}, {0.25, 0, 0.125}, UP, "o"}),
     "a ball sunk in a plate"},
    {"far", 5, OBLIQUE, 1.0, AWAY, WINGS, "wings, 18.8 km away from the origin"},
    {"tiny", 5, OBLIQUE, 0x1p-20, HERE, WINGS, "wings, 2^-20 times as large: some microns"},
    {"huge", 5, OBLIQUE, 0x1p+20, HERE, WINGS, "wings, 2^20 times as large: 5000 km"},
    {NULL, 0, 0, 0.0, HERE, NULL, NULL}};
