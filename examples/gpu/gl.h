/* SPDX-License-Identifier: MIT */
/* OpenGL 3.3 without a window: the functions that the example calls, and what starts them. */
#ifndef EXAMPLE_GL_H
#define EXAMPLE_GL_H

#include <GL/glcorearb.h>

/* Every function is fetched by name, so that nothing but libEGL is linked. */
#define GL_FUNCTIONS(X)                                                                            \
    X(PFNGLATTACHSHADERPROC, glAttachShader)                                                       \
    X(PFNGLBINDBUFFERPROC, glBindBuffer)                                                           \
    X(PFNGLBINDFRAMEBUFFERPROC, glBindFramebuffer)                                                 \
    X(PFNGLBINDRENDERBUFFERPROC, glBindRenderbuffer)                                               \
    X(PFNGLBINDVERTEXARRAYPROC, glBindVertexArray)                                                 \
    X(PFNGLBUFFERDATAPROC, glBufferData)                                                           \
    X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, glCheckFramebufferStatus)                                   \
    X(PFNGLCLEARBUFFERFVPROC, glClearBufferfv)                                                     \
    X(PFNGLCLEARBUFFERUIVPROC, glClearBufferuiv)                                                   \
    X(PFNGLCOMPILESHADERPROC, glCompileShader)                                                     \
    X(PFNGLCREATEPROGRAMPROC, glCreateProgram)                                                     \
    X(PFNGLCREATESHADERPROC, glCreateShader)                                                       \
    X(PFNGLCULLFACEPROC, glCullFace)                                                               \
    X(PFNGLDEPTHFUNCPROC, glDepthFunc)                                                             \
    X(PFNGLDISABLEPROC, glDisable)                                                                 \
    X(PFNGLDRAWARRAYSPROC, glDrawArrays)                                                           \
    X(PFNGLDRAWBUFFERSPROC, glDrawBuffers)                                                         \
    X(PFNGLENABLEPROC, glEnable)                                                                   \
    X(PFNGLENABLEVERTEXATTRIBARRAYPROC, glEnableVertexAttribArray)                                 \
    X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, glFramebufferRenderbuffer)                                 \
    X(PFNGLGENBUFFERSPROC, glGenBuffers)                                                           \
    X(PFNGLGENFRAMEBUFFERSPROC, glGenFramebuffers)                                                 \
    X(PFNGLGENRENDERBUFFERSPROC, glGenRenderbuffers)                                               \
    X(PFNGLGENVERTEXARRAYSPROC, glGenVertexArrays)                                                 \
    X(PFNGLGETERRORPROC, glGetError)                                                               \
    X(PFNGLGETPROGRAMINFOLOGPROC, glGetProgramInfoLog)                                             \
    X(PFNGLGETPROGRAMIVPROC, glGetProgramiv)                                                       \
    X(PFNGLGETSTRINGPROC, glGetString)                                                             \
    X(PFNGLGETUNIFORMLOCATIONPROC, glGetUniformLocation)                                           \
    X(PFNGLLINKPROGRAMPROC, glLinkProgram)                                                         \
    X(PFNGLPIXELSTOREIPROC, glPixelStorei)                                                         \
    X(PFNGLPOLYGONOFFSETPROC, glPolygonOffset)                                                     \
    X(PFNGLREADBUFFERPROC, glReadBuffer)                                                           \
    X(PFNGLREADPIXELSPROC, glReadPixels)                                                           \
    X(PFNGLRENDERBUFFERSTORAGEPROC, glRenderbufferStorage)                                         \
    X(PFNGLSHADERSOURCEPROC, glShaderSource)                                                       \
    X(PFNGLUNIFORMMATRIX3FVPROC, glUniformMatrix3fv)                                               \
    X(PFNGLUNIFORM3FVPROC, glUniform3fv)                                                           \
    X(PFNGLUSEPROGRAMPROC, glUseProgram)                                                           \
    X(PFNGLVERTEXATTRIBPOINTERPROC, glVertexAttribPointer)                                         \
    X(PFNGLVIEWPORTPROC, glViewport)

#define GL_DECLARE(type, name) extern type name;
GL_FUNCTIONS(GL_DECLARE)

/* Makes a context current on the first device that has OpenGL 3.3; returns 0 if there is none. */
int gl_start(void);

/* A program, or 0 with the compiler's words on stderr. */
GLuint gl_program(const char *vertex_shader, const char *fragment_shader);

/* Selects size x size pixels to draw to, with two colours and a depth: facets as whole numbers (the
   item buffer), shades as floats (8-bit colours would round the glint away), and a depth as float.
   Returns 0 if there are no such buffers. */
int gl_target(GLsizei size);

#endif
