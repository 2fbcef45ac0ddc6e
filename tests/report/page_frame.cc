#include "tests/report/page_frame.h"

namespace collision::report {

const char kPageHead[] = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>collisiond, measured</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff; margin: 0 auto;
       padding: 0 1rem 4rem; max-width: 66rem; }
h1 { margin-bottom: 0; } h2 { margin-top: 2.5rem; } h3, h4 { margin: 0 0 0.3rem; }
nav { line-height: 2; } nav a { margin-right: 1rem; white-space: nowrap; }
.charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(26rem, 100%), 1fr));
          gap: 1.5rem; }
figure { margin: 0; } figure img { width: 100%; height: auto; }
figcaption { font-size: 0.9rem; } figcaption ul { margin: 0.3rem 0 0; padding-left: 1.2rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.85rem; margin: 0.5rem 0; }
th, td { text-align: left; vertical-align: top; padding: 0.15rem 0.6rem 0.15rem 0;
         border-bottom: 1px solid #eee; font-variant-numeric: tabular-nums; }
.verdict { font-size: 0.95rem; width: 100%; }
.verdict th, .verdict td { padding: 0.3rem 0.8rem 0.3rem 0; border-color: #ddd; }
.verdict tbody th { font-weight: 400; } .verdict th.group { font-weight: 700; padding-top: 1.2rem; }
.verdict td:nth-child(4) { font-weight: 600; white-space: nowrap; }
.kept td:nth-child(4) { color: #00694f; } .kept td:nth-child(4)::before { content: "✓ "; }
.missed td:nth-child(4) { color: #b00020; } .missed td:nth-child(4)::before { content: "✗ "; }
.unknown { color: #666; }
.bad { color: #b00020; font-weight: 600; } .small { font-size: 0.85rem; color: #555; }
summary { cursor: pointer; }
.part { border-top: 1px solid #ccc; padding: 0.6rem 0; }
.part > summary { font-size: 1.15rem; font-weight: 600; }
@media (max-width: 40rem) {
  .verdict thead { display: none; }
  .verdict tr, .verdict th, .verdict td { display: block; border: 0; padding: 0; }
  .verdict tr { border-bottom: 1px solid #ddd; padding: 0.5rem 0; }
  .verdict tbody th { font-weight: 600; }
  .verdict td { padding-left: 6rem; text-indent: -6rem; }
  .verdict td[data-title]::before { content: attr(data-title); display: inline-block; width: 6rem;
                                    text-indent: 0; color: #555; font-weight: 400; }
  .verdict td:nth-child(4) { white-space: normal; }
}
@media print {
  nav { display: none; } h2, summary { break-after: avoid; } figure, tr { break-inside: avoid; }
  .wide { overflow: visible; } body { max-width: none; font-size: 11px; }
  details::details-content { content-visibility: visible; display: block; }
}
</style></head><body>
)";

const char kPageEnd[] = R"(<script>
const all = () => document.querySelectorAll('details');
function unfoldTarget() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!target) return;
  for (let e = target; e; e = e.parentElement) if (e.tagName === 'DETAILS') e.open = true;
  target.scrollIntoView();
}
addEventListener('hashchange', unfoldTarget);
// A link to where the page is already changes no hash.
document.addEventListener('click', e => {
  const link = e.target.closest('a[href^="#"]');
  if (link && link.hash === location.hash) unfoldTarget();
});
const button = document.getElementById('unfold');
button.addEventListener('click', () => {
  const open = button.textContent === 'unfold all';
  for (const d of all()) d.open = open;
  button.textContent = open ? 'fold all' : 'unfold all';
});
let folded = [];
addEventListener('beforeprint', () => {
  folded = [...all()].filter(d => !d.open);
  for (const d of folded) d.open = true;
});
addEventListener('afterprint', () => { for (const d of folded) d.open = false; });
unfoldTarget();
</script></body></html>
)";

}  // namespace collision::report
