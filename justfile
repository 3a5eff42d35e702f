# Thin names for plain cargo commands; `just` lists them. None of them is needed: README.md and CONTRIBUTING.md say the
# commands themselves.

bench := "data-samples/published-bench"

[private]
default:
    @just --list

# The sample study: Tables II-VI on the terminal, sizes in results.parquet
run-sample:
    cargo run -- run {{bench}} --out results.parquet

# The sample study against the tables that it must give
check-sample:
    cargo run -- run {{bench}} --out results.parquet --expect {{bench}}/expected --tolerance 0.15

# All tests, as in the README
test:
    cargo test --workspace

# What CI denies
lint:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets --locked -- -D warnings

# Formats the code
fmt:
    cargo fmt --all

# Speed against cp, numpy and pandas, and peak memory (docs/performance.md); AIM_BATCH_PYTHON names a Python that has them
bench-speed *parts:
    cargo bench -p aim-batch-pipeline -- {{parts}}

# Looks for defects in a parser: packets, csv, cwa, exchange, labelme, config_toml, image, mcap, timeline (cargo install cargo-fuzz)
fuzz target seconds="600":
    mkdir -p fuzz/found/{{target}}
    cargo fuzz run --sanitizer none {{target}} fuzz/found/{{target}} fuzz/corpus/{{target}} -- -max_total_time={{seconds}} -max_len=16384 -timeout=10 -rss_limit_mb=2048

# Licences, sources and homes of dependencies (cargo install cargo-deny --locked --version ^0.20)
deny:
    cargo deny check

# Rewrites golden files and generated documents; read the difference before you commit it
update-golden:
    AIM_BATCH_UPDATE=1 INSTA_UPDATE=always cargo test --workspace

# Makes the sample study anew
bench-data out="target/published-bench":
    cargo run -- simulate published-bench -o {{out}}

# Documentation of the code
docs:
    cargo doc --workspace --no-deps --open

# Everything that CI runs
ci:
    .ci/run
