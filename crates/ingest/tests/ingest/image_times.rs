//! Image times from names and from EXIF.

use aim_batch_ingest::parse::image_time::{TimeError, check_pattern, from_both, from_exif, from_name};
use jiff::tz::TimeZone;
use model::UtcNs;

use crate::support::{NOON_S, jpeg, jpeg_with_exif, jpeg_with_exif_fields, png};

const SECOND: i64 = 1_000_000_000;

// Tags of EXIF.
const ORIGINAL: u16 = 0x9003;
const OFFSET: u16 = 0x9010;
const OFFSET_ORIGINAL: u16 = 0x9011;

fn chicago() -> TimeZone {
    TimeZone::get("America/Chicago").unwrap()
}

#[test]
fn a_pattern_that_ends_in_z_is_utc() {
    let pattern = "%Y%m%dT%H%M%S%.fZ";
    assert_eq!(check_pattern(pattern), Ok(()));
    let expected = UtcNs(NOON_S * SECOND + 250_000_000);
    for name in ["20250601T120000.25Z.JPG", "20250601T120000.250Z", "20250601T120000.25Z.jpeg"] {
        assert_eq!(from_name(name, pattern, &chicago()), Ok(expected), "{name}");
    }
    assert_eq!(from_name("20250601T120000Z.JPG", pattern, &chicago()), Ok(UtcNs(NOON_S * SECOND)));
    assert_eq!(from_name("20250601T120000Z.jpg", "%Y%m%dT%H%M%SZ.jpg", &chicago()), Ok(UtcNs(NOON_S * SECOND)));
}

#[test]
fn a_pattern_without_zone_is_in_the_study_s_zone() {
    let noon_in_chicago = UtcNs((NOON_S + 5 * 3600) * SECOND);
    assert_eq!(from_name("IMG_20250601_120000.jpg", "IMG_%Y%m%d_%H%M%S", &chicago()), Ok(noon_in_chicago));
    // A fraction is no extension.
    let fraction = from_name("20250601T120000.125", "%Y%m%dT%H%M%S%.f", &chicago());
    assert_eq!(fraction, Ok(UtcNs(noon_in_chicago.0 + 125_000_000)));
}

#[test]
fn an_offset_or_posix_seconds_in_the_name_decide() {
    let noon = Ok(UtcNs(NOON_S * SECOND));
    assert_eq!(from_name("20250601T140000+0200.jpg", "%Y%m%dT%H%M%S%z", &chicago()), noon);
    assert_eq!(from_name("1748779200.jpg", "%s", &chicago()), noon);
}

#[test]
fn a_local_time_that_is_none_or_two_is_refused() {
    let changes = [
        ("America/Chicago", "20250309T023000", "20250309T013000", "20250309T033000", 1),
        ("America/Chicago", "20251102T013000", "20251102T003000", "20251102T023000", 3),
        ("Europe/Berlin", "20250330T023000", "20250330T013000", "20250330T033000", 1),
        ("Europe/Berlin", "20251026T023000", "20251026T013000", "20251026T033000", 3),
    ];
    for (zone, change, before, after, hours) in changes {
        let zone = TimeZone::get(zone).unwrap();
        let from_name = |local: &str| from_name(&format!("{local}.jpg"), "%Y%m%dT%H%M%S", &zone);
        let from_exif = |local: &str| from_exif(&jpeg_with_exif(Some(&exif_text(local)), None, None), &zone);
        for at in [&from_name as &dyn Fn(&str) -> _, &from_exif] {
            let error = at(change).unwrap_err();
            assert!(matches!(error, TimeError::Ambiguous { .. }), "{change} in {zone:?}: {error}");
            let passed = (at(after).unwrap().0 - at(before).unwrap().0) / (3600 * SECOND);
            assert_eq!(passed, hours, "2 h of the clock around {change}");
        }
    }
}

/// 20250309T023000 as EXIF writes it.
fn exif_text(local: &str) -> String {
    let part = |range: std::ops::Range<usize>| &local[range];
    format!("{}:{}:{} {}:{}:{}", part(0..4), part(4..6), part(6..8), part(9..11), part(11..13), part(13..15))
}

#[test]
fn name_and_exif_check_each_other() {
    let at = |seconds: f64| Ok(UtcNs(NOON_S * SECOND).plus_seconds(seconds));
    let none = || Err(TimeError::Exif("none".to_owned()));
    assert_eq!(from_both(at(0.0), at(2.0), 2.0), Ok((at(0.0).unwrap(), false)), "the name's");
    assert_eq!(from_both(at(0.0), none(), 2.0), Ok((at(0.0).unwrap(), true)));
    assert_eq!(from_both(none(), at(5.0), 2.0), Ok((at(5.0).unwrap(), true)));
    let error = from_both(at(0.0), at(-3600.25), 2.0).unwrap_err().to_string();
    assert_eq!(
        error,
        "the name says 2025-06-01T12:00:00Z, EXIF says 2025-06-01T10:59:59.75Z: 3600.25 s apart, more than 2 s"
    );
    assert_eq!(from_both(none(), none(), 2.0).unwrap_err().to_string().matches("EXIF gives no time").count(), 2);
}

#[test]
fn a_name_that_does_not_fit_says_so() {
    let error = from_name("DSC001.JPG", "%Y%m%dT%H%M%S%.fZ", &TimeZone::UTC).unwrap_err();
    assert!(error.to_string().starts_with("the name 'DSC001.JPG' does not fit '%Y%m%dT%H%M%S%.fZ'"), "{error}");
    assert!(matches!(from_name("19690101T000000Z", "%Y%m%dT%H%M%SZ", &TimeZone::UTC), Err(TimeError::Range(_))));
}

#[test]
fn patterns_that_give_no_time_are_refused() {
    for pattern in ["%Y%m%d", "%Y%m%d_%H%M", "image", "%H%M%S", "%Q%", "%!", "%s%f", "%Y%m%d_%s", "%Y%m%d %I%M%S"] {
        assert!(check_pattern(pattern).is_err(), "{pattern}");
    }
    for pattern in [
        "%Y%m%dT%H%M%S",
        "%s",
        "%s%.f",
        "%s_%f",
        "%s.%3f",
        "%Y%m%d %I%M%S %p",
        "IMG_%Y-%m-%d_%H-%M-%S",
        "%Y%m%dT%H%M%S%z",
    ] {
        assert_eq!(check_pattern(pattern), Ok(()), "{pattern}");
    }
}

#[test]
fn exif_gives_the_time_with_subseconds_and_offset() {
    let local = Some("2025:06:01 12:00:00");
    let time = |subsec, offset| from_exif(&jpeg_with_exif(local, subsec, offset), &chicago());
    assert_eq!(time(None, None), Ok(UtcNs((NOON_S + 5 * 3600) * SECOND)), "the study's zone");
    assert_eq!(time(Some("25"), Some("+00:00")), Ok(UtcNs(NOON_S * SECOND + 250_000_000)));
    assert_eq!(time(Some("123456"), Some("-03:30")), Ok(UtcNs((NOON_S + 12_600) * SECOND + 123_456_000)));
    assert_eq!(time(None, Some("   :  ")), Ok(UtcNs((NOON_S + 5 * 3600) * SECOND)), "a blank offset is none");
}

#[test]
fn the_offset_of_the_file_s_time_does_where_the_picture_s_is_absent() {
    let local = "2025:06:01 12:00:00";
    let time = |fields: &[(u16, &str)]| from_exif(&jpeg_with_exif_fields(fields), &chicago());
    let noon = Ok(UtcNs(NOON_S * SECOND));
    assert_eq!(time(&[(ORIGINAL, local), (OFFSET, "+00:00")]), noon);
    assert_eq!(time(&[(ORIGINAL, local), (OFFSET, "+00:00"), (OFFSET_ORIGINAL, "   :  ")]), noon, "blank is absent");
    let both = time(&[(ORIGINAL, local), (OFFSET, "+05:00"), (OFFSET_ORIGINAL, "+00:00")]);
    assert_eq!(both, noon, "the picture's own goes first");
}

#[test]
fn exif_without_a_usable_time_says_so() {
    let error = |image: &[u8]| from_exif(image, &TimeZone::UTC).unwrap_err().to_string();
    assert!(error(&jpeg_with_exif(None, Some("25"), None)).contains("no DateTimeOriginal"));
    assert!(error(&jpeg_with_exif(Some("2025:13:01 12:00:00"), None, None)).contains("is no date and time"));
    assert!(
        error(&jpeg_with_exif(Some("2025:06:01 12:00:00"), None, Some("+02h00"))).starts_with("EXIF gives no time")
    );
    assert!(error(&jpeg(32, 24, 1)).starts_with("EXIF gives no time"));
    assert!(error(&png(32, 24)).starts_with("EXIF gives no time"));
}

#[test]
fn seconds_since_1970_keep_their_fraction() {
    let expected = Ok(UtcNs(1_614_613_210_750_000_000));
    for (name, pattern) in [
        ("1614613210.750000.jpg", "%s%.f"),
        ("1614613210.75", "%s%.f"),
        ("1614613210_750.jpg", "%s_%f"),
        ("cam0-1614613210.750000000.png", "cam0-%s.%9f"),
    ] {
        assert_eq!(from_name(name, pattern, &chicago()), expected, "{name}");
    }
    // A fraction that the pattern does not describe is not taken for an extension.
    for (name, pattern) in [("1614613210.750000", "%s"), ("20250601T120000.250Z", "%Y%m%dT%H%M%S")] {
        assert!(matches!(from_name(name, pattern, &chicago()), Err(TimeError::Name { .. })), "{name}");
    }
}

#[test]
fn a_zone_in_the_name_decides() {
    let noon = from_name("2025-06-01 14.00.00 Europe/Berlin.jpg", "%Y-%m-%d %H.%M.%S %Q", &chicago());
    assert_eq!(noon, Ok(UtcNs(NOON_S * SECOND)));
}

#[test]
fn the_text_behind_the_seconds_of_exif_counts() {
    let time = |local: &str| from_exif(&jpeg_with_exif(Some(local), None, None), &chicago());
    let at = |hours: i64, ms: i64| Ok(UtcNs((NOON_S + hours * 3600) * SECOND + ms * 1_000_000));
    assert_eq!(time("2025:06:01 12:00:00.25"), at(5, 250));
    assert_eq!(time("2025:06:01 12:00:00Z"), at(0, 0));
    assert_eq!(time("2025:06:01 12:00:00+02:00"), at(-2, 0));
    assert_eq!(time("2025:06:01 12:00:00.125-0330"), Ok(UtcNs((NOON_S + 12_600) * SECOND + 125_000_000)));
    assert_eq!(time("2025:06:01 12:00:00 "), at(5, 0));
    for odd in ["PM", ".", "+02h", "+2:00", " UTC", ".25Zx", "+02:00:30", "+99:00"] {
        let error = time(&format!("2025:06:01 12:00:00{odd}")).unwrap_err().to_string();
        assert!(error.contains("behind the time"), "{odd}: {error}");
    }
}

#[test]
fn fraction_and_offset_that_stand_twice_must_agree() {
    let time = |local, subsec, offset| from_exif(&jpeg_with_exif(Some(local), subsec, offset), &chicago());
    let quarter = Ok(UtcNs(NOON_S * SECOND + 250_000_000));
    assert_eq!(time("2025:06:01 12:00:00.250Z", Some("25"), Some("+00:00")), quarter);
    assert!(time("2025:06:01 12:00:00.250", Some("75"), None).is_err());
    assert!(time("2025:06:01 12:00:00Z", None, Some("+02:00")).is_err());
    assert!(time("2025:06:01 12:00:00", Some("25x"), None).is_err());
    assert!(time("2025:06:01 12:00:00", None, Some("+02:00:30")).is_err());
}
