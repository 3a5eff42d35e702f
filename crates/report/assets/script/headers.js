// Headings that sort.

/** Makes the headings of a table buttons. `sort(column)` sorts, `state()` tells by what it is sorted. */
function sortableHeaders(headings, sort, state) {
  const show = () => {
    const { column, descending } = state();
    headings.forEach((heading, place) => {
      heading.setAttribute("aria-sort", place === column ? (descending ? "descending" : "ascending") : "none");
    });
  };
  headings.forEach((heading, place) => {
    const button = element("button", { type: "button", title: heading.title || false });
    heading.removeAttribute("title");
    button.append(...heading.childNodes);
    button.addEventListener("click", () => {
      sort(place);
      show();
    });
    heading.append(button);
  });
  show();
}

/** A field that filters, with its label; `found` hears of every change. */
function searchField(label, name, found) {
  const field = element("input", { type: "search", class: "control", name, autocomplete: "off", spellcheck: "false" });
  field.addEventListener("input", () => found(field.value));
  return element("label", {}, label, field);
}
