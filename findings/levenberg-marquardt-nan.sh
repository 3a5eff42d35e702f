#!/usr/bin/env bash
# One would expect: a fit whose every trial step gives NaN ends with the reason `Numerical`, which the crate has for that, or at
#   least not as a success.
# What happens: levenberg-marquardt 0.15 shortens its steps until they are too small to matter and reports that it has converged,
#   with the parameters that it was started with and an unreduced sum of squares. scipy's three methods do the same.
# Why it matters here: pixels beyond what a lens can image, and rays above the horizon, have no place on the table. A fit that
#   meets only those looks finished. Its residuals must be judged, whatever it reports.
# Source: https://docs.rs/levenberg-marquardt/0.15.0/levenberg_marquardt/enum.TerminationReason.html (Numerical)
# Needs: cargo, python3 3.11.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check scipy==1.17.1 numpy==2.4.6
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'END'
[package]
name = "finding"
version = "0.0.0"
edition = "2024"

[dependencies]
levenberg-marquardt = "=0.15.0"
nalgebra = { version = "=0.34.2", default-features = false, features = ["std"] }
END
cat > "$folder/src/main.rs" <<'END'
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{Matrix1, Owned, U1, Vector1};

const START: f64 = 2.0;

/// A residual of 1 at the start, and NaN elsewhere: the start is the last point of the model's domain.
struct AtTheEdge(Vector1<f64>);

impl LeastSquaresProblem<f64, U1, U1> for AtTheEdge {
    type ResidualStorage = Owned<f64, U1>;
    type JacobianStorage = Owned<f64, U1, U1>;
    type ParameterStorage = Owned<f64, U1>;

    fn set_params(&mut self, parameters: &Vector1<f64>) {
        self.0 = *parameters;
    }

    fn params(&self) -> Vector1<f64> {
        self.0
    }

    fn residuals(&self) -> Option<Vector1<f64>> {
        Some(Vector1::new(if self.0[0] >= START { 1.0 + self.0[0] - START } else { f64::NAN }))
    }

    fn jacobian(&self) -> Option<Matrix1<f64>> {
        Some(Matrix1::new(1.0))
    }
}

fn main() {
    let (solved, report) = LevenbergMarquardt::new().minimize(AtTheEdge(Vector1::new(START)));
    let success = report.termination.was_successful();
    println!("levenberg-marquardt 0.15.0: {:?}, success: {success}", report.termination);
    println!("parameter {} (start {START}), half the sum of squares {}", solved.0[0], report.objective_function);
    if !success || solved.0[0] != START || report.objective_function != 0.5 {
        eprintln!("changed: expected success at the start");
        std::process::exit(1);
    }
}
END
cat > "$folder/fit.py" <<'END'
import sys

import numpy
import scipy
from scipy.optimize import least_squares

START = 2.0


def residual(parameters):
    return numpy.array([1 + parameters[0] - START if parameters[0] >= START else numpy.nan])


changed = False
for method in ("lm", "trf", "dogbox"):
    fit = least_squares(residual, [START], jac=lambda _: numpy.array([[1.0]]), method=method)
    print(f"scipy {scipy.__version__} {method}: success {fit.success}, parameter {fit.x[0]}, cost {fit.cost}")
    changed |= not fit.success or fit.x[0] != START or fit.cost != 0.5
sys.exit("changed: expected success at the start" if changed else 0)
END
export CARGO_TARGET_DIR="$folder/target"
cargo run --quiet --manifest-path "$folder/Cargo.toml"
"$folder/venv/bin/python" "$folder/fit.py"
echo "as before"
