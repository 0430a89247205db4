#include "apps/output/text/report_style.h"

namespace gestell::apps
{

const char *const report_style = R"css(
:root { --paper: #ffffff; --ink: #22272e; --soft: #5b6570; --rule: #d9dee4; --band: #f5f7f9;
        --warn: #8a4b00; --warn-band: #fff4e0; --warn-rule: #e0a030; }
@media screen and (prefers-color-scheme: dark) {
  :root { --paper: #16191d; --ink: #d8dde3; --soft: #98a2ad; --rule: #333a42; --band: #1d2126;
          --warn: #ffce85; --warn-band: #2b2213; --warn-rule: #8a6420; }
}
* { box-sizing: border-box; }
html { color-scheme: light dark; }
body { margin: 0 auto; padding: 2.2rem 1.6rem 4rem; max-width: 66rem; background: var(--paper); color: var(--ink);
       font: 16px/1.55 system-ui, "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .3rem; }
h2 { font-size: 1.25rem; margin: 2.4rem 0 .6rem; padding-top: .7rem; border-top: 1px solid var(--rule); }
h3 { font-size: 1rem; margin: 1.4rem 0 .4rem; }
p { margin: .5rem 0; max-width: 44rem; }
.soft { color: var(--soft); }
.lead { font-size: 1.08rem; }
nav { margin: 1rem 0 0; font-size: .92rem; }
nav a { color: inherit; margin-right: 1.1rem; }
.warnings { margin: 1.3rem 0; padding: .7rem 1.1rem; background: var(--warn-band); border-left: 4px solid var(--warn-rule);
            color: var(--warn); }
.warnings ul { margin: .2rem 0; padding-left: 1.2rem; }
table { border-collapse: collapse; margin: .7rem 0 1.1rem; font-variant-numeric: tabular-nums; font-size: .94rem; }
th, td { padding: .26rem .9rem .26rem 0; text-align: left; border-bottom: 1px solid var(--rule); vertical-align: top; }
th { font-weight: 600; color: var(--soft); white-space: nowrap; }
.n { text-align: right; white-space: nowrap; }
td.peak { font-weight: 600; }
.scroll { overflow: auto; max-height: 26rem; border: 1px solid var(--rule); padding: 0 .9rem; display: inline-block;
          max-width: 100%; }
.wide { overflow-x: auto; }
.wide th, .scroll th { white-space: normal; vertical-align: bottom; }
.wide td:first-child, .scroll td:first-child { white-space: nowrap; }
.keys { display: flex; flex-wrap: wrap; gap: .6rem 2.2rem; margin: .9rem 0; }
.keys strong { display: block; font-size: 1.25rem; font-variant-numeric: tabular-nums; }
.keys span { color: var(--soft); font-size: .88rem; }
figure { margin: .9rem 0 1.5rem; }
figure svg { max-width: 100%; height: auto; display: block; }
figcaption { color: var(--soft); font-size: .88rem; max-width: 44rem; }
.row { display: flex; flex-wrap: wrap; gap: 1.2rem 1.6rem; align-items: flex-start; }
.row figure { margin: 0; flex: 1 1 17rem; }
.modes { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)); gap: 1rem; }
.modes figure { margin: 0; }
.bars { display: grid; grid-template-columns: repeat(auto-fill, minmax(24rem, 1fr)); gap: 1rem; }
.bars figure { margin: 0; }
pre { background: var(--band); padding: .8rem 1rem; overflow-x: auto; font-size: .86rem; line-height: 1.45; }
footer { margin-top: 3rem; padding-top: .7rem; border-top: 1px solid var(--rule); color: var(--soft); font-size: .88rem; }
@media print {
  @page { size: A4; margin: 16mm 14mm; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  nav { display: none; }
  h2 { margin-top: 1.4rem; }
  .scroll, .wide { max-height: none; overflow: visible; border: 0; padding: 0; display: block; }
  table { font-size: 8.5pt; max-width: 100%; }
  th, td { padding-right: .5rem; }
  .many table { font-size: 6.6pt; }
  .many th, .many td { padding-right: .3rem; }
  th, th.n { white-space: normal; }
  #view { display: none; }
  pre { white-space: pre-wrap; overflow: visible; font-size: 8pt; }
  figure, tr, .keys, .warnings, h2 + p, h3 + p { break-inside: avoid; }
  .long { columns: 2; column-gap: 1.5rem; }
  h1, h2, h3, h2 + p, h3 + p { break-after: avoid; }
  .modes { grid-template-columns: repeat(3, 1fr); }
  .bars { grid-template-columns: repeat(2, 1fr); }
}
)css";

} // namespace gestell::apps
