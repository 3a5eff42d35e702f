//! Results to Parquet, and results to error tables. Knows nothing of sessions or images on cards.
