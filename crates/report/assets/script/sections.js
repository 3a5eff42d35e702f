// Sections: a link opens the one that it leads to, the contents tell which one is read, paper gets all of them.

function openAround(target) {
  for (let at = target; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
}

function openTarget() {
  const name = decodeURIComponent(location.hash.slice(1));
  const target = name && document.getElementById(name);
  if (!target) return;
  openAround(target);
  target.scrollIntoView();
}

function startSections() {
  addEventListener("hashchange", openTarget);
  openTarget();
  const links = new Map();
  for (const link of document.querySelectorAll(".contents a")) {
    links.set(link.hash.slice(1), link);
    // A link to the place where one already is makes no hashchange.
    link.addEventListener("click", () => openAround(document.getElementById(link.hash.slice(1))));
  }
  const sections = [...document.querySelectorAll(".section")];
  let current = null;
  const mark = () => {
    const line = innerHeight / 3;
    const passed = sections.filter((section) => section.getBoundingClientRect().top <= line);
    const atEnd = scrollY > 0 && innerHeight + scrollY >= document.documentElement.scrollHeight - 2;
    const link = links.get((atEnd ? sections.at(-1) : passed.at(-1) ?? sections[0]).id);
    if (link === current) return;
    current?.removeAttribute("aria-current");
    link?.setAttribute("aria-current", "true");
    // On a narrow screen the contents are one line, of which a part shows.
    if (link) link.closest("ul").scrollLeft = link.offsetLeft - link.offsetWidth / 2;
    current = link;
  };
  let asked = false;
  addEventListener("scroll", () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      mark();
    });
  }, { passive: true });
  mark();
  openForPaper(sections);
}

function openForPaper(sections) {
  let closed = [];
  addEventListener("beforeprint", () => {
    closed = sections.filter((section) => section.tagName === "DETAILS" && !section.open);
    for (const section of closed) section.open = true;
  });
  addEventListener("afterprint", () => {
    for (const section of closed) section.open = false;
  });
}
