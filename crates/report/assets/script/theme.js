// Light, dark, or as the system has it.

const THEMES = ["system", "light", "dark"];

function startTheme() {
  const button = document.getElementById("theme");
  const show = (theme) => {
    if (theme === "system") delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
    button.textContent = `Colours: ${theme}`;
    button.dataset.theme = theme;
  };
  let kept = null;
  try {
    kept = localStorage.getItem("aim-batch-theme");
  } catch {
    // a browser may keep nothing for files from disk
  }
  show(THEMES.includes(kept) ? kept : "system");
  button.hidden = false;
  button.addEventListener("click", () => {
    const next = THEMES[(THEMES.indexOf(button.dataset.theme) + 1) % THEMES.length];
    show(next);
    try {
      localStorage.setItem("aim-batch-theme", next);
    } catch {
      // as above
    }
  });
}
