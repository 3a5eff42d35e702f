// Images that the report has in several views, side by side: as taken, lens corrected, on the table plane.

/** Images so shown; the viewer has all others. */
const MOST_EXAMPLES = 3;

const VIEW_NOTES = {
  camera: "As taken, with what was marked.",
  corrected: "Lens corrected: edges that are straight are straight in it.",
  plane: "Projected on the table plane Z = 0: lengths on the table are true in it.",
};

function startExamples(section, index) {
  const examples = [...index.byImage.values()].filter((pictures) => pictures.length > 1).slice(0, MOST_EXAMPLES);
  if (examples.length === 0) return;
  section.append(...examples.map(exampleOf));
  section.hidden = false;
}

function exampleOf(pictures) {
  const [{ session, image }] = pictures;
  const shown = (picture) =>
    element("figure", {}, stage(picture, { all: true }), element("figcaption", {}, VIEW_NOTES[picture.view]));
  const title = `${image.split("/").at(-1)} of ${session}`;
  return element("div", { class: "example" }, element("h4", {}, title), element("div", { class: "views" }, ...pictures.map(shown)));
}
