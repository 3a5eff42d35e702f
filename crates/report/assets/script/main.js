// Starts what the page has.

startTheme();
for (const table of document.querySelectorAll("table.data")) {
  if (table.dataset.rows) startLongTable(table);
  else startStaticTable(table);
}
const index = new PictureIndex(dataOf("pictures-data"));
startMeasurements(document.getElementById("measurements-table"), index);
startExamples(document.getElementById("examples"), index);
startSections();
