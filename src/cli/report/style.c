/* SPDX-License-Identifier: MIT */
/* The style of the page: one column of text, wide elements in boxes of their own, light and dark.
   Charts are drawn on white with few colours; each of these is replaced here for dark mode. */
#include "cli/report/report.h"

static const char *const style_parts[] = {
    /* colours */
    ":root{color-scheme:light dark;--paper:#fbfbfa;--card:#fff;--ink:#1c1e21;--faint:#5c636d;"
    "--rule:#e1e3e6;--mark:#0b62b0;--bar:#9cc3e6}\n"
    "@media(prefers-color-scheme:dark){:root{--paper:#121518;--card:#191d21;--ink:#e4e6e9;"
    "--faint:#9fa7b1;--rule:#2d3339;--mark:#80b9f0;--bar:#35618b}\n"
    ".chart rect[fill=\"#ffffff\"],.chart polygon[fill=\"#ffffff\"]{fill:#191d21}\n"
    ".chart polygon[fill=\"#f4f1e8\"]{fill:#24241f}\n"
    ".chart text[fill=\"#222222\"]{fill:#e4e6e9}.chart text[fill=\"#666666\"]{fill:#9fa7b1}\n"
    ".chart polyline[stroke=\"#222222\"]{stroke:#c9ced4}"
    ".chart polyline[stroke=\"#666666\"]{stroke:#9fa7b1}\n"
    ".chart polyline[stroke=\"#d9d9d9\"]{stroke:#3b424a}"
    ".chart polyline[stroke=\"#efefef\"]{stroke:#262b31}\n"
    ".chart polyline[stroke=\"#0072b2\"]{stroke:#5cb0e8}"
    ".chart polygon[fill=\"#0072b2\"],.chart text[fill=\"#0072b2\"]{fill:#5cb0e8}}\n",
    /* text */
    "*{box-sizing:border-box}\n"
    "html{-webkit-text-size-adjust:100%;text-size-adjust:100%}\n"
    "body{margin:0;background:var(--paper);color:var(--ink);"
    "font:16px/1.55 system-ui,-apple-system,\"Segoe UI\",Roboto,\"Helvetica "
    "Neue\",Arial,sans-serif;"
    "overflow-wrap:break-word}\n"
    "header,nav,main,footer{max-width:62rem;margin:0 auto;padding:0 1.25rem}\n"
    "header{padding-top:2.75rem}\n"
    ".kind{margin:0;color:var(--faint);font-size:.95rem}\n"
    "h1{margin:.1rem 0 "
    "1rem;font-size:2.1rem;line-height:1.2;font-weight:600;overflow-wrap:anywhere}\n"
    "h2{margin:0 0 .9rem;font-size:1.35rem;line-height:1.3;font-weight:600}\n"
    "h3{margin:1.6rem 0 .5rem;font-size:1rem;font-weight:600}\n"
    "p,.notices{max-width:44rem;margin:.6rem 0}\n"
    ".lead{margin:0;font-size:1.5rem;line-height:1.35}.lead b{font-weight:600}\n"
    ".lead span{color:var(--faint);white-space:nowrap}\n"
    ".faint,figcaption{color:var(--faint);font-size:.9rem}\n"
    "a{color:var(--mark);text-underline-offset:.15em}\n"
    "sup{line-height:0;font-size:.7em}\n",
    "nav{margin-top:1.5rem}\n"
    "nav ul{display:flex;flex-wrap:wrap;gap:.25rem 1.1rem;margin:0;padding:.6rem 0;list-style:none;"
    "border-top:1px solid var(--rule);border-bottom:1px solid var(--rule);font-size:.92rem}\n"
    "nav a{text-decoration:none}nav a:hover{text-decoration:underline}\n"
    "section{padding:2.2rem 0 .4rem}\n"
    ".notices{padding-left:1.1rem}.notices li{margin:.25rem 0}\n"
    "footer{margin-top:2rem;padding-top:1rem;padding-bottom:3rem;color:var(--faint);font-size:."
    "88rem}\n"
    "footer p{border-top:1px solid var(--rule);padding-top:1rem;max-width:none}\n"
    /* facts */
    ".facts{display:grid;grid-template-columns:repeat(auto-fill,minmax(12.5rem,1fr));gap:.9rem "
    "1.5rem;"
    "margin:1rem 0}\n"
    ".facts dt{color:var(--faint);font-size:.85rem}\n"
    ".facts dd{margin:0;font-variant-numeric:tabular-nums;overflow-wrap:anywhere}\n",
    /* tables */
    ".wide{overflow-x:auto;margin:.8rem 0 1.2rem}\n"
    ".wide:focus-visible,pre:focus-visible{outline:2px solid var(--mark);outline-offset:2px}\n"
    "table{border-collapse:collapse;min-width:100%;font-size:.92rem;font-variant-numeric:tabular-"
    "nums}\n"
    "th{text-align:left;font-weight:600;color:var(--faint);font-size:.82rem;vertical-align:bottom;"
    "white-space:nowrap}\n"
    "th,td{padding:.32rem .9rem .32rem 0;border-bottom:1px solid var(--rule)}\n"
    "td{vertical-align:top}.name{min-width:7.5rem;overflow-wrap:anywhere}.why{min-width:12rem}\n"
    "th:last-child,td:last-child{padding-right:0}\n"
    ".n{text-align:right;white-space:nowrap}\n"
    ".bar{width:7rem;min-width:4rem;vertical-align:middle}\n"
    ".bar i{display:block;height:.55rem;background:var(--bar);border-radius:1px}\n"
    ".others td{color:var(--faint)}\n"
    ".dot{display:inline-block;width:.8em;height:.8em;margin-right:.45em;border-radius:50%;"
    "border:1px solid var(--faint);vertical-align:-.05em}\n"
    ".on{font-weight:600}.off{color:var(--faint)}\n"
    "details{margin:.6rem 0 1rem}summary{cursor:pointer;color:var(--mark);font-weight:600}\n"
    "summary:focus-visible{outline:2px solid var(--mark);outline-offset:2px}\n"
    "@media print{details::details-content{content-visibility:visible;block-size:auto}}\n",
    /* figures */
    "figure{margin:1rem 0 1.4rem;min-width:0}\n"
    ".chart,figure picture{display:block;background:var(--card);border:1px solid var(--rule);"
    "border-radius:6px;overflow-x:auto}\n"
    ".chart svg{display:block;width:100%;height:auto;min-width:38rem}\n"
    "figure img{display:block;width:100%;height:auto;border-radius:5px}\n"
    "figcaption{margin-top:.45rem;max-width:44rem}\n"
    ".pair{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,17rem),1fr));"
    "gap:0 1.25rem}\n"
    ".pair .chart svg{min-width:0}.pair .chart text{font-size:15px}\n"
    "pre{overflow-x:auto;margin:.5rem 0;padding:.75rem 1rem;background:var(--card);"
    "border:1px solid var(--rule);border-radius:6px;"
    "font:.86rem/1.5 ui-monospace,SFMono-Regular,Menlo,Consolas,\"Liberation Mono\",monospace}\n"
    "@media(max-width:40rem){header{padding-top:1.6rem}h1{font-size:1.65rem}.lead{font-size:1."
    "25rem}"
    ".facts{grid-template-columns:repeat(auto-fill,minmax(9rem,1fr))}}\n"
    "@media print{nav{display:none}body{font-size:11pt}figure,tr{break-inside:avoid}"
    ".wide,.chart,pre{overflow:visible}}\n"};

void cli_report_style(FILE *out)
{
    for (size_t i = 0; i < sizeof style_parts / sizeof style_parts[0]; i++) {
        fputs(style_parts[i], out);
    }
}
