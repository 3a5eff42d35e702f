// Small helpers. Text goes in as text nodes only: no name from a study is ever read as HTML.

/** An element with attributes (functions become listeners, true an empty attribute) and children. */
function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(key, value);
    else if (value === true) made.setAttribute(key, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** An SVG element. */
function svg(name, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** The JSON in a script element. */
function dataOf(id) {
  return JSON.parse(document.getElementById(id).textContent);
}

const whole = new Intl.NumberFormat("en");
const byWords = new Intl.Collator("en", { numeric: true, sensitivity: "base" });
