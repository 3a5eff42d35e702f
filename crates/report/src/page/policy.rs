//! The rights that the page has in a browser: to be shown, and to run its own script, and nothing else.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use sha2::{Digest as _, Sha256};

/// The Content Security Policy of a page whose one script is `script`. No request leaves the page except for pictures beside it,
/// and a script that came in by a name would not run. Styles within figures are allowed, since they can fetch nothing.
pub(super) fn content_security_policy(script: &str) -> String {
    let hash = BASE64_STANDARD.encode(Sha256::digest(script));
    format!(
        "default-src 'none'; script-src 'sha256-{hash}'; style-src 'unsafe-inline'; img-src 'self' data: file:; base-uri \
         'none'; form-action 'none'"
    )
}

#[cfg(test)]
mod tests {
    use super::content_security_policy;

    /// The digest of "alert(1)" comes from `printf 'alert(1)' | openssl dgst -sha256 -binary | base64`.
    #[test]
    fn the_script_is_named_by_its_hash() {
        assert!(
            content_security_policy("alert(1)")
                .contains("script-src 'sha256-bhHHL3z2vDgxUt0W3dWQOrprscmda2Y5pLsLg4GF+pI='")
        );
    }
}
