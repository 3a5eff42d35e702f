//! dev
use ingest::Picture;
use model::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n = |i: usize| a[i].parse::<f64>().unwrap();
    // image fx fy cx cy pitch roll range lens k1 k2 k3 k4
    let bytes = std::fs::read(&a[1]).unwrap();
    let t = std::time::Instant::now();
    let p = Picture::decode(&bytes).unwrap();
    let decode = t.elapsed().as_secs_f64() * 1e3;
    let lens = match a.get(9).map(String::as_str) {
        Some("radial") => LensModel::Radial(lens::Radial { k1: n(10) }),
        Some("division") => LensModel::Division(lens::Division { lambda: n(10) }),
        Some("fisheye") => LensModel::Fisheye(lens::Fisheye { k1: n(10), k2: n(11), k3: n(12), k4: n(13) }),
        _ => LensModel::None,
    };
    let camera = Camera::new([p.width_px, p.height_px], [n(2), n(3)], [n(4), n(5)], 0.0, lens).unwrap();
    let view = View::new(camera, Pose::new(n(6).to_radians(), n(7).to_radians(), n(8)).unwrap());
    let t = std::time::Instant::now();
    let rims = aim_batch_pipeline::rims::find_rims(&p, &view).unwrap();
    eprintln!("decode {decode:.1} ms, rims {:.1} ms", t.elapsed().as_secs_f64() * 1e3);
    let rows: Vec<_> = rims.iter().map(|r| serde_json::json!({
        "confidence": r.confidence, "coverage": r.coverage, "center": [r.center_px.x, r.center_px.y],
        "points": r.points_px.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>(),
        "height": r.height.mm, "height_sigma": r.height.sigma_mm, "source": format!("{:?}", r.height.source),
        "debug": r.debug,
    })).collect();
    println!("{}", serde_json::Value::from(rows));
}
