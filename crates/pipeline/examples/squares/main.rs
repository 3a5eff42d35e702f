//! Pictures only, for now.
mod scenes;
use rayon::prelude::*;
use simulate::laid::SceneSpec;
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let a: Vec<String> = std::env::args().skip(1).collect();
    let (seed, plates, others, width) = (a[0].parse::<u64>()?, a[1].parse::<u64>()?, a[2].parse::<u64>()?, a[3].parse::<u32>()?);
    let camera = simulate::laid::camera([width, width * 3 / 4])?;
    let folder = std::env::var("AIM_BATCH_LAID_PICTURES")?;
    let all: Vec<(scenes::Set, u64)> = (0..plates).map(|n| (scenes::Set::Plates, n)).chain((0..others).map(|n| (scenes::Set::Others, n))).collect();
    all.par_iter().for_each(|(set, n)| {
        let text = scenes::scene(*set, seed, *n);
        let spec: SceneSpec = toml::from_str(&text).unwrap_or_else(|e| panic!("{e}: {text}"));
        for plan in spec.plans(seed * 100_000 + n, width).unwrap() {
            for (i, frame) in plan.frames.iter().enumerate() {
                let name = format!("{folder}/{set:?}-{width}-{seed}-{n:03}-{i}.jpg").to_lowercase();
                if std::path::Path::new(&name).exists() { continue; }
                let view = frame.view(&camera).unwrap();
                std::fs::write(&name, frame.photograph(&view).to_jpeg("x").unwrap()).unwrap();
            }
        }
    });
    Ok(())
}
