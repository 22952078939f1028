/* SPDX-License-Identifier: MIT */
/* The letters' strokes, and the width of a text. The Hershey Fonts were originally created by Dr.
   A. V. Hershey while working at the U. S. National Bureau of Standards (1967). The format of the
   font data was originally created by James Hurt, Cognition, Inc., 900 Technology Park Drive,
   Billerica, MA 01821. This is the plain roman ("futural"), ASCII 32 to 126; anyone may use it for
   any purpose with this acknowledgement. */
#include "host/chart/letters.h"

#include <stddef.h>

/* An SVG is drawn in a font of the browser, in which lines measured so much wider than these. */
#define LETTERS_WIDER      1.05
#define LETTERS_WIDER_BOLD 1.15

/* Two characters a point, x right and y down, each its distance from 'R'; " R" lifts the plotter.
   The first pair is the left and the right side. Capitals stand on 9 and rise to -12. */
static const char *const letter_strokes[] = {
    "JZ",                                                                         /*   */
    "MWRFRT RRYQZR[SZRY",                                                         /* ! */
    "JZNFNM RVFVM",                                                               /* " */
    "H]SBLb RYBRb RLOZO RKUYU",                                                   /* # */
    "H\\PBP_ RTBT_ RYIWGTFPFMGKIKKLMMNOOUQWRXSYUYXWZT[P[MZKX",                    /* $ */
    "F^[FI[ RNFPHPJOLMMKMIKIIJGLFNFPGSHVHYG[F RWTUUTWTYV[X[ZZ[X[VYTWT",           /* % */
    "E_\\O\\N[MZMYNXPVUTXRZP[L[JZIYHWHUISJRQNRMSKSIRGPFNGMIMKNNPQUXWZY[[[\\Z\\Y", /* & */
    "MWRHQGRFSGSIRKQL",                                                           /* ' */
    "KYVBTDRGPKOPOTPYR]T`Vb",                                                     /* ( */
    "KYNBPDRGTKUPUTTYR]P`Nb",                                                     /* ) */
    "JZRLRX RMOWU RWOMU",                                                         /* * */
    "E_RIR[ RIR[R",                                                               /* + */
    "NVSWRXQWRVSWSYQ[",                                                           /* , */
    "E_IR[R",                                                                     /* - */
    "NVRVQWRXSWRV",                                                               /* . */
    "G][BIb",                                                                     /* / */
    "H\\QFNGLJKOKRLWNZQ[S[VZXWYRYOXJVGSFQF",                                      /* 0 */
    "H\\NJPISFS[",                                                                /* 1 */
    "H\\LKLJMHNGPFTFVGWHXJXLWNUQK[Y[",                                            /* 2 */
    "H\\MFXFRNUNWOXPYSYUXXVZS[P[MZLYKW",                                          /* 3 */
    "H\\UFKTZT RUFU[",                                                            /* 4 */
    "H\\WFMFLOMNPMSMVNXPYSYUXXVZS[P[MZLYKW",                                      /* 5 */
    "H\\XIWGTFRFOGMJLOLTMXOZR[S[VZXXYUYTXQVOSNRNOOMQLT",                          /* 6 */
    "H\\YFO[ RKFYF",                                                              /* 7 */
    "H\\PFMGLILKMMONSOVPXRYTYWXYWZT[P[MZLYKWKTLRNPQOUNWMXKXIWGTFPF",              /* 8 */
    "H\\XMWPURRSQSNRLPKMKLLINGQFRFUGWIXMXRWWUZR[P[MZLX",                          /* 9 */
    "NVROQPRQSPRO RRVQWRXSWRV",                                                   /* : */
    "NVROQPRQSPRO RSWRXQWRVSWSYQ[",                                               /* ; */
    "F^ZIJRZ[",                                                                   /* < */
    "E_IO[O RIU[U",                                                               /* = */
    "F^JIZRJ[",                                                                   /* > */
    "I[LKLJMHNGPFTFVGWHXJXLWNVORQRT RRYQZR[SZRY",                                 /* ? */
    ("E`WNVLTKQKOLNMMPMSNUPVSVUUVS RQKOMNPNSOUPV "
     "RWKVSVUXVZV\\T]Q]O\\L[JYHWGTFQFNGLHJJILHOHRIUJWLYNZQ[T[WZYYZX RXKWSWUXV"), /* @ */
    "I[RFJ[ RRFZ[ RMTWT",                                                        /* A */
    "G\\KFK[ RKFTFWGXHYJYLXNWOTP RKPTPWQXRYTYWXYWZT[K[",                         /* B */
    "H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZV",                                    /* C */
    "G\\KFK[ RKFRFUGWIXKYNYSXVWXUZR[K[",                                         /* D */
    "H[LFL[ RLFYF RLPTP RL[Y[",                                                  /* E */
    "HZLFL[ RLFYF RLPTP",                                                        /* F */
    "H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZVZS RUSZS",                            /* G */
    "G]KFK[ RYFY[ RKPYP",                                                        /* H */
    "NVRFR[",                                                                    /* I */
    "JZVFVVUYTZR[P[NZMYLVLT",                                                    /* J */
    "G\\KFK[ RYFKT RPOY[",                                                       /* K */
    "HYLFL[ RL[X[",                                                              /* L */
    "F^JFJ[ RJFR[ RZFR[ RZFZ[",                                                  /* M */
    "G]KFK[ RKFY[ RYFY[",                                                        /* N */
    "G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF",                              /* O */
    "G\\KFK[ RKFTFWGXHYJYMXOWPTQKQ",                                             /* P */
    "G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF RSWY]",                        /* Q */
    "G\\KFK[ RKFTFWGXHYJYLXNWOTPKP RRPY[",                                       /* R */
    "H\\YIWGTFPFMGKIKKLMMNOOUQWRXSYUYXWZT[P[MZKX",                               /* S */
    "JZRFR[ RKFYF",                                                              /* T */
    "G]KFKULXNZQ[S[VZXXYUYF",                                                    /* U */
    "I[JFR[ RZFR[",                                                              /* V */
    "F^HFM[ RRFM[ RRFW[ R\\FW[",                                                 /* W */
    "H\\KFY[ RYFK[",                                                             /* X */
    "I[JFRPR[ RZFRP",                                                            /* Y */
    "H\\YFK[ RKFYF RK[Y[",                                                       /* Z */
    "KYOBOb RPBPb ROBVB RObVb",                                                  /* [ */
    "KYKFY^",                                                                    /* backslash */
    "KYTBTb RUBUb RNBUB RNbUb",                                                  /* ] */
    "JZRDJR RRDZR",                                                              /* ^ */
    "I[Ib[b",                                                                    /* _ */
    "NVSKQMQORPSORNQO",                                                          /* ` */
    "I\\XMX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX",                                     /* a */
    "H[LFL[ RLPNNPMSMUNWPXSXUWXUZS[P[NZLX",                                      /* b */
    "I[XPVNTMQMONMPLSLUMXOZQ[T[VZXX",                                            /* c */
    "I\\XFX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX",                                     /* d */
    "I[LSXSXQWOVNTMQMONMPLSLUMXOZQ[T[VZXX",                                      /* e */
    "MYWFUFSGRJR[ ROMVM",                                                        /* f */
    "I\\XMX]W`VaTbQbOa RXPVNTMQMONMPLSLUMXOZQ[T[VZXX",                           /* g */
    "I\\MFM[ RMQPNRMUMWNXQX[",                                                   /* h */
    "NVQFRGSFREQF RRMR[",                                                        /* i */
    "MWRFSGTFSERF RSMS^RaPbNb",                                                  /* j */
    "IZMFM[ RWMMW RQSX[",                                                        /* k */
    "NVRFR[",                                                                    /* l */
    "CaGMG[ RGQJNLMOMQNRQR[ RRQUNWMZM\\N]Q][",                                   /* m */
    "I\\MMM[ RMQPNRMUMWNXQX[",                                                   /* n */
    "I\\QMONMPLSLUMXOZQ[T[VZXXYUYSXPVNTMQM",                                     /* o */
    "H[LMLb RLPNNPMSMUNWPXSXUWXUZS[P[NZLX",                                      /* p */
    "I\\XMXb RXPVNTMQMONMPLSLUMXOZQ[T[VZXX",                                     /* q */
    "KXOMO[ ROSPPRNTMWM",                                                        /* r */
    "J[XPWNTMQMNNMPNRPSUTWUXWXXWZT[Q[NZMX",                                      /* s */
    "MYRFRWSZU[W[ ROMVM",                                                        /* t */
    "I\\MMMWNZP[S[UZXW RXMX[",                                                   /* u */
    "JZLMR[ RXMR[",                                                              /* v */
    "G]JMN[ RRMN[ RRMV[ RZMV[",                                                  /* w */
    "J[MMX[ RXMM[",                                                              /* x */
    "JZLMR[ RXMR[P_NaLbKb",                                                      /* y */
    "J[XMM[ RMMXM RM[X[",                                                        /* z */
    "KYTBRCQDPFPHQJRKSMSOQQ RRCQEQGRISJTLTNSPORSTTVTXSZR[Q]Q_Ra RQSSUSWRYQZP\\P^Q`RaTb", /* { */
    "NVRBRb",                                                                            /* | */
    "KYPBRCSDTFTHSJRKQMQOSQ RRCSESGRIQJPLPNQPURQTPVPXQZR[S]S_Ra RSSQUQWRYSZT\\T^S`RaPb", /* } */
    "F^IUISJPLONOPPTSVTXTZS[Q RISJQLPNPPQTTVUXUZT[Q[O",                                  /* ~ */
};

#define LETTER_EM   29.0 /* capitals are 0.72 em high */
#define LETTER_BASE 9
/* The font was made for wide plotters: with this factor it is as wide as a common sans serif. */
#define LETTER_NARROW 0.92
#define LETTER_SPACE  0.33 /* em */

/* A character that the font lacks becomes one question mark for all bytes of its UTF-8 sequence. */
static const char *letter_find(char letter)
{
    unsigned char byte = (unsigned char)letter;
    return (byte & 0xc0) == 0x80      ? NULL
           : byte < 32 || byte >= 127 ? letter_strokes['?' - 32]
                                      : letter_strokes[byte - 32];
}

static double letter_width(const char *strokes)
{
    return !strokes                       ? 0.0
           : strokes == letter_strokes[0] ? LETTER_SPACE
                                          : LETTER_NARROW * (strokes[1] - strokes[0]) / LETTER_EM;
}

double lrcsi_letters_width(const char *text)
{
    double width = 0.0;
    for (; *text; text++) {
        width += letter_width(letter_find(*text));
    }
    return width;
}

void lrcsi_letters_fit(lrcsi_plotter *plotter, lrcsi_plot_text label, double room)
{
    double wider = label.bold ? LETTERS_WIDER_BOLD : LETTERS_WIDER;
    double width = label.size * lrcsi_letters_width(label.text) * wider;
    label.size *= width > room ? room / width : 1.0;
    plotter->text(plotter, &label);
}

int lrcsi_letters_next(lrcsi_letters *letters, lrcsi_plot_point *point)
{
    int move = LRCSI_LETTERS_DRAW;
    while (*letters->text) {
        const char *strokes = letter_find(*letters->text);
        if (strokes && !letters->at) {
            letters->at = strokes + 2;
            move = LRCSI_LETTERS_JUMP;
        } else if (strokes && letters->at[0] == ' ') {
            letters->at += 2;
            move = LRCSI_LETTERS_JUMP;
        }
        if (strokes && *letters->at) {
            point->x = letters->x + LETTER_NARROW * (letters->at[0] - strokes[0]) / LETTER_EM;
            point->y = (LETTER_BASE - (letters->at[1] - 'R')) / LETTER_EM;
            letters->at += 2;
            return move;
        }
        letters->x += letter_width(strokes);
        letters->at = NULL;
        letters->text++;
    }
    return LRCSI_LETTERS_END;
}
