// What scrolls can be reached by the keyboard; landmarks and links of the gallery have names.
document.addEventListener("DOMContentLoaded", () => {
  for (const element of document.querySelectorAll("pre, .table-wrapper, div.math")) {
    if (element.scrollWidth > element.clientWidth) element.tabIndex = 0;
  }
  const names = { ".sidebar-drawer": "Navigation", ".toc-drawer": "On this page" };
  for (const [selector, name] of Object.entries(names)) {
    document.querySelector(selector)?.setAttribute("aria-label", name);
  }
  for (const link of document.querySelectorAll(".sphx-glr-thumbcontainer a")) {
    link.setAttribute("aria-label", link.textContent);
  }
});
