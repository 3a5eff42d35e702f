//! Camera files: every lens model, and every way to get one wrong.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::lens::{Division, Fisheye, PlumbBob, Radial};
use aim_batch_model::{Camera, CameraError, CameraSpec, CameraSpecError, LensModel};

const HEAD: &str =
    "schema_version = 1\nname = 'unit 7'\nwidth_px = 2592\nheight_px = 1944\nprincipal_px = [1296.0, 972.0]\n";
const PIXELS: &str = "focal_px = [1700.0, 1690.0]\n";
const MILLIMETRES: &str = "focal_mm = 2.5\nscale_px_per_mm = [700.0, 710.0]\n";

fn parse(text: &str) -> CameraSpec {
    toml::from_str(text).unwrap()
}

fn camera(focal: &str, lens: &str) -> Result<Camera, CameraSpecError> {
    parse(&format!("{HEAD}{focal}[lens]\n{lens}")).camera()
}

/// The parser's message for a file that it must refuse.
fn refusal(text: &str) -> String {
    toml::from_str::<CameraSpec>(text).unwrap_err().to_string()
}

#[test]
fn every_lens_model_is_read() {
    let cases = [
        ("model = 'none'", LensModel::None),
        ("model = 'radial'\nk1 = -0.2", LensModel::Radial(Radial { k1: -0.2 })),
        ("model = 'division'\nlambda = -0.3", LensModel::Division(Division { lambda: -0.3 })),
        (
            "model = 'plumb_bob'\nk1 = -0.3\nk2 = 0.1\np1 = 0.001\np2 = -0.002\nk3 = 0.01",
            LensModel::PlumbBob(PlumbBob { k1: -0.3, k2: 0.1, p1: 0.001, p2: -0.002, k3: 0.01 }),
        ),
        ("model = 'plumb_bob'\nk1 = -0.3", LensModel::PlumbBob(PlumbBob { k1: -0.3, ..PlumbBob::default() })),
        (
            "model = 'fisheye'\nk1 = 0.1\nk2 = 0.02\nk3 = 0.003\nk4 = 0.0004",
            LensModel::Fisheye(Fisheye { k1: 0.1, k2: 0.02, k3: 0.003, k4: 0.0004 }),
        ),
        ("model = 'fisheye'\nk1 = 0.1", LensModel::Fisheye(Fisheye { k1: 0.1, ..Fisheye::default() })),
    ];
    for (text, expected) in cases {
        let camera = camera(PIXELS, text).unwrap();
        assert_eq!(*camera.lens(), expected, "{text}");
        let written = toml::to_string(&CameraSpec::from_camera("unit 7", &camera)).unwrap();
        assert_eq!(parse(&written).camera().unwrap(), camera, "{written}");
    }
}

#[test]
fn focal_lengths_in_pixels_and_in_millimetres_make_the_same_camera() {
    let in_pixels = camera("focal_px = [1750.0, 1775.0]\n", "model = 'radial'\nk1 = -0.25").unwrap();
    let in_mm = camera(MILLIMETRES, "model = 'radial'\nk_per_mm2 = -0.04").unwrap(); // k1 = K_c f^2 = -0.04 * 6.25
    assert_eq!(in_pixels, in_mm);
}

#[test]
fn skew_is_optional() {
    assert_eq!(camera(PIXELS, "model = 'none'").unwrap().skew_px().to_bits(), 0.0_f64.to_bits());
    let skewed = camera(&format!("{PIXELS}skew_px = 1.5\n"), "model = 'none'").unwrap();
    assert_eq!(skewed.skew_px().to_bits(), 1.5_f64.to_bits());
}

#[test]
fn a_written_file_reads_back() {
    for lens in ["model = 'none'", "model = 'radial'\nk_per_mm2 = -0.03", "model = 'plumb_bob'\nk1 = 0.1"] {
        let spec = parse(&format!("{HEAD}{MILLIMETRES}[lens]\n{lens}"));
        assert_eq!(parse(&toml::to_string(&spec).unwrap()), spec, "{lens}");
    }
}

#[test]
fn unknown_keys_are_refused_by_name() {
    let lens = "[lens]\nmodel = 'none'\n";
    assert!(refusal(&format!("{HEAD}{PIXELS}focal = 1\n{lens}")).contains("unknown field `focal`"));
    for model in ["none", "radial", "division", "plumb_bob", "fisheye"] {
        let coefficients = if model == "division" { "lambda = 0.0\n" } else { "" };
        let needed = if matches!(model, "plumb_bob" | "fisheye") { "k1 = 0.0\n" } else { coefficients };
        let message = refusal(&format!("{HEAD}{PIXELS}[lens]\nmodel = '{model}'\n{needed}k9 = 0.1\n"));
        assert!(message.contains("unknown field `k9`"), "{model}: {message}");
    }
    let message = refusal(&format!("{HEAD}{PIXELS}[lens]\nmodel = 'pinhole'\n"));
    assert!(message.contains("unknown variant `pinhole`") && message.contains("plumb_bob"), "{message}");
}

#[test]
fn missing_keys_are_named() {
    assert!(refusal(&format!("{HEAD}{PIXELS}")).contains("missing field `lens`"));
    assert!(refusal(&format!("{HEAD}{PIXELS}[lens]\nmodel = 'division'\n")).contains("missing field `lambda`"));
    assert!(refusal(&format!("{PIXELS}[lens]\nmodel = 'none'\n")).contains("missing field `schema_version`"));
}

#[test]
fn the_focal_length_is_given_once_and_whole() {
    let none = "model = 'none'";
    let refused = |focal: &str| camera(focal, none).unwrap_err();
    assert_eq!(refused(""), CameraSpecError::FocalLength("neither"));
    assert_eq!(refused(&format!("{PIXELS}{MILLIMETRES}")), CameraSpecError::FocalLength("both"));
    let partial = refused("focal_mm = 2.4\n");
    assert!(partial.to_string().contains("focal_mm without scale_px_per_mm"), "{partial}");
    let partial = refused("scale_px_per_mm = [700.0, 700.0]\n");
    assert!(partial.to_string().contains("scale_px_per_mm without focal_mm"), "{partial}");
}

#[test]
fn the_radial_coefficient_is_given_once_and_in_known_units() {
    let refused = |focal: &str, lens: &str| camera(focal, &format!("model = 'radial'\n{lens}")).unwrap_err();
    assert_eq!(refused(PIXELS, ""), CameraSpecError::RadialCoefficient("neither"));
    assert_eq!(refused(MILLIMETRES, "k1 = 0.1\nk_per_mm2 = 0.1"), CameraSpecError::RadialCoefficient("both"));
    assert_eq!(refused(PIXELS, "k_per_mm2 = 0.1"), CameraSpecError::NoMillimetres);
}

#[test]
fn numbers_that_make_no_camera_are_refused() {
    let version = parse(&format!("{HEAD}{PIXELS}[lens]\nmodel = 'none'\n").replace("version = 1", "version = 2"));
    assert_eq!(version.camera().unwrap_err(), CameraSpecError::Version(2));
    let refused = |focal: &str, lens: &str| camera(focal, lens).unwrap_err();
    assert_eq!(
        refused("focal_px = [0.0, 1700.0]\n", "model = 'none'"),
        CameraSpecError::Camera(CameraError::BadFocalLength(0.0))
    );
    assert_eq!(
        refused(PIXELS, "model = 'division'\nlambda = nan"),
        CameraSpecError::Camera(CameraError::NotFinite("a lens coefficient"))
    );
    let empty = parse(&format!("{HEAD}{PIXELS}[lens]\nmodel = 'none'\n").replace("2592", "0"));
    assert_eq!(empty.camera().unwrap_err(), CameraSpecError::Camera(CameraError::EmptyPicture(0, 1944)));
}
