//! dev
use ingest::Picture;
use model::{Camera, LensModel, Pose, View};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n = |i: usize| a[i].parse::<f64>().unwrap();
    // image fx fy cx cy pitch roll range
    let bytes = std::fs::read(&a[1]).unwrap();
    let t = std::time::Instant::now();
    let p = Picture::decode(&bytes).unwrap();
    eprintln!("decode {:.1} ms", t.elapsed().as_secs_f64() * 1e3);
    let camera = Camera::new([p.width_px, p.height_px], [n(2), n(3)], [n(4), n(5)], 0.0, LensModel::None).unwrap();
    let view = View::new(camera, Pose::new(n(6).to_radians(), n(7).to_radians(), n(8)).unwrap());
    for row in aim_batch_pipeline::rims::dump(&p, &view) {
        println!("{}", row.map(|v| format!("{v:.4}")).join(" "));
    }
}
