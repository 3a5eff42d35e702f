// Pictures and the marks on them.

/** Pictures by session and image. */
class PictureIndex {
  constructor(pictures) {
    this.byImage = new Map();
    for (const picture of pictures) {
      const key = PictureIndex.key(picture.session, picture.image);
      if (!this.byImage.has(key)) this.byImage.set(key, []);
      this.byImage.get(key).push(picture);
    }
  }

  static key(session, image) {
    return JSON.stringify([session, image]);
  }

  of(session, image) {
    return this.byImage.get(PictureIndex.key(session, image)) ?? [];
  }
}

const VIEWS = { camera: "As taken", corrected: "Lens corrected", plane: "On the table plane" };

/** Whether a mark is of the row: all raters' for a row of all; of no row in particular every mark is. */
function isOfRow(mark, { object, rater, level, all = false }) {
  return all || mark.object === object && (mark.rater === rater || level === "consensus");
}

/** The picture with its marks over it; those of the row stand out, others are dashed. */
function stage(picture, row, withMarks = true) {
  const { width, height, session, image, view } = picture;
  const shown = withMarks ? picture.marks : [];
  const names = [...new Set(shown.filter((mark) => isOfRow(mark, row)).map((mark) => `${mark.feature} of ${mark.object} by ${mark.rater}`))];
  const marked = names.length > 0 ? `, with ${names.join(", ")}` : "";
  const alt = `${VIEWS[view]}: ${image} of ${session}${marked}`;
  const overlay = svg("svg", { viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" });
  const own = shown.filter((mark) => isOfRow(mark, row));
  for (const mark of shown.filter((one) => !isOfRow(one, row))) overlay.append(outline(mark, "other"));
  for (const mark of own) overlay.append(outline(mark, "edge"), outline(mark, "line"));
  return element("div", { class: "stage" },
    element("img", { src: picture.source, alt, width, height, loading: "lazy", decoding: "async" }), overlay);
}

function outline(mark, kind) {
  return svg(mark.closed ? "polygon" : "polyline", { points: mark.points, class: `mark ${kind}` });
}
