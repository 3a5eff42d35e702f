// Choices above the measurements.

/** Columns that a row is chosen by, where they differ. */
const CHOICES = ["level", "quantity", "method", "session", "object", "rater"];
/** More than these are found by typing. */
const MOST_CHOICES = 400;

/** One list per column. `changed` hears of every choice. */
function choiceFields(grid, rows, changed) {
  return CHOICES.map((name) => {
    const place = grid.columns.findIndex((column) => column.name === name);
    if (place < 0) return null;
    const words = [...new Set(grid.rows.map((row) => row[place]))].filter((word) => word !== null);
    if (words.length < 2 || words.length > MOST_CHOICES) return null;
    words.sort((a, b) => byWords.compare(grid.words[a], grid.words[b]));
    const option = (word) => element("option", { value: word }, grid.words[word]);
    const list = element("select", { class: "control", name }, element("option", { value: "" }, "all"), ...words.map(option));
    list.addEventListener("change", () => {
      const chosen = list.value === "" ? null : Number(list.value);
      rows.test(name, chosen === null ? null : (row) => row[place] === chosen);
      changed();
    });
    return element("label", {}, grid.columns[place].heading, list);
  });
}

/** A box for the rows of selected images, where there are others. */
function selectedField(grid, rows, changed) {
  const place = grid.columns.findIndex((column) => column.name === "selected");
  if (place < 0 || grid.rows.every((row) => row[place] === 1)) return null;
  const box = element("input", { type: "checkbox", name: "selected" });
  box.addEventListener("change", () => {
    rows.test("selected", box.checked ? (row) => row[place] === 1 : null);
    changed();
  });
  return element("label", { class: "check" }, box, "selected only");
}
