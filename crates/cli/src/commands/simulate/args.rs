//! The arguments of `simulate`.

use std::path::{Path, PathBuf};

use clap::ValueEnum;

/// The arguments of `simulate`.
#[derive(Debug, clap::Args)]
pub struct SimulateArgs {
    /// Study to make: published-bench, large, bench, worn, or a scene file NAME.toml (docs/simulate.md)
    #[arg(value_name = "PRESET|SCENE.toml", value_parser = parse_study_to_make)]
    pub study: StudyToMake,
    /// Folder of the new study; must be empty or not exist
    #[arg(short, long)]
    pub out: PathBuf,
    /// Seed of all randomness; default: 1, or the scene file's
    #[arg(long)]
    pub seed: Option<u64>,
    /// Everything but the pictures (published-bench)
    #[arg(long)]
    pub no_pictures: bool,
    /// How large the study is
    #[command(flatten)]
    pub large: LargeArgs,
}

/// Options of the presets `large`, `worn` and `bench`: each takes some of them.
#[derive(Debug, Default, PartialEq, clap::Args)]
#[command(next_help_heading = "Presets large, worn and bench")]
pub struct LargeArgs {
    /// Sessions; default: 300 (large), 4 (worn)
    #[arg(long, value_name = "N")]
    pub sessions: Option<u32>,
    /// Images of each session; default: 24 (large, worn)
    #[arg(long, value_name = "N")]
    pub images: Option<u32>,
    /// Size of the pictures; default: 320x240 (large), 1296x972 (worn, bench)
    #[arg(long, value_name = "WxH", value_parser = parse_size_px)]
    pub image_size: Option<[u32; 2]>,
    /// Per cent of the sessions that are damaged, each in another way; default: 0 (large)
    #[arg(long, value_name = "PCT")]
    pub damage: Option<f64>,
}

/// Width and height in pixels of a text such as `320x240`.
fn parse_size_px(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse::<u32>().ok();
    let size = text.split_once('x').and_then(|(width, height)| Some([side(width)?, side(height)?]));
    size.ok_or_else(|| "expected width and height in pixels, such as 320x240".to_owned())
}

/// A study that `simulate` can make.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum StudyToMake {
    /// One of the program's own studies.
    Preset(Preset),
    /// The study that this scene file describes.
    Scene(PathBuf),
}

/// The study of a text such as `worn` or `kitchen.toml`. Fails where the text is neither a preset nor ends in `.toml`.
fn parse_study_to_make(text: &str) -> Result<StudyToMake, String> {
    if Path::new(text).extension().is_some_and(|extension| extension == "toml") {
        return Ok(StudyToMake::Scene(PathBuf::from(text)));
    }
    Preset::from_str(text, false).map(StudyToMake::Preset).map_err(|_| {
        let names = Preset::value_variants()
            .iter()
            .filter_map(|preset| Some(preset.to_possible_value()?.get_name().to_owned()));
        format!("expected one of {}, or a scene file that ends in .toml", names.collect::<Vec<_>>().join(", "))
    })
}

/// The studies that the program can make without a scene file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Preset {
    /// The paper's bench and worn sessions, rebuilt from the published readings
    PublishedBench,
    /// Many sessions with small pictures, for load tests; some of them damaged, if asked for
    Large,
    /// Rendered: nine setups, eight empty plates, bowls and boxes each, on tables with other things
    Bench,
    /// Rendered: people eating, with hands, cutlery and food, and heads that move
    Worn,
}
