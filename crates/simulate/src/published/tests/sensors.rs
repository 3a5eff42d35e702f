use super::*;

/// The samples of all packets of one sensor as (POSIX time, counts per channel), decoded by hand as the profile says.
fn decode(session: &Path, prefix: &str, channels: usize) -> Vec<(f64, Vec<i16>)> {
    let mut samples = Vec::new();
    for file in ["0001", "0002"] {
        let bytes = fs::read(session.join(format!("SENSORS/{prefix}{file}.BIN"))).unwrap();
        let packet_bytes = 8 + 2 * 1022 * channels;
        assert_eq!(bytes.len() % packet_bytes, 0);
        for packet in bytes.chunks_exact(packet_bytes) {
            let stamp_s = f64::from_le_bytes(packet[..8].try_into().unwrap());
            let count = |channel: usize, i: usize| {
                let at = 8 + 2 * (1022 * channel + i);
                i16::from_le_bytes([packet[at], packet[at + 1]])
            };
            for i in 0..1022_u16 {
                let counts = (0..channels).map(|channel| count(channel, usize::from(i))).collect();
                samples.push((stamp_s + f64::from(i) / 128.0, counts));
            }
        }
    }
    samples
}

fn around(samples: &[(f64, Vec<i16>)], time_s: f64, half_s: f64) -> Vec<&[i16]> {
    samples.iter().filter(|(t, _)| (t - time_s).abs() <= half_s).map(|(_, counts)| counts.as_slice()).collect()
}

#[expect(clippy::cast_precision_loss, reason = "a few hundred samples")]
fn mean(samples: &[&[i16]], channel: usize) -> f64 {
    samples.iter().map(|counts| f64::from(counts[channel])).sum::<f64>() / samples.len() as f64
}

/// The pitch of the camera in degrees, which is that of gravity plus the mount offset of 21 degrees.
fn camera_pitch_deg(samples: &[&[i16]]) -> f64 {
    (-mean(samples, 2)).atan2(-mean(samples, 1)).to_degrees() + 21.0
}

/// The root mean square of the departures from the mean, over all axes together, in mg.
#[expect(clippy::cast_precision_loss, reason = "a few hundred samples")]
fn motion_mg(samples: &[&[i16]]) -> f64 {
    let square = |axis: usize| {
        let mean = mean(samples, axis);
        samples.iter().map(|counts| (f64::from(counts[axis]) - mean).powi(2)).sum::<f64>() / samples.len() as f64
    };
    (square(0) + square(1) + square(2)).sqrt()
}

#[test]
fn packets_give_the_planned_pitch_and_range_at_every_image() {
    let (_keep, root) = study(Options::default().seed);
    for session in all_sessions() {
        let card = root.join("cards").join(&session.name);
        let (acceleration, range) = (decode(&card, "ACC", 4), decode(&card, "RNG", 1));
        for shot in &session.shots {
            let image_s = session.start.plus_seconds(shot.time_s).seconds_since(model::UtcNs(0));
            let place = format!("{} at {} s", session.name, shot.time_s);

            let near = around(&acceleration, image_s, 1.0);
            let pitch_error_deg = camera_pitch_deg(&near) - shot.pose.pitch_rad().to_degrees();
            assert!(pitch_error_deg.abs() < 0.003, "{place}: pitch is off by {pitch_error_deg} degrees");
            assert!((mean(&near, 0)).abs() < 0.1, "{place}: roll");
            let rest_mg = motion_mg(&around(&acceleration, image_s, 2.5));
            assert!((2.0..15.0).contains(&rest_mg), "{place}: {rest_mg} mg");

            let mut valid: Vec<i16> =
                around(&range, image_s, 0.5).iter().map(|counts| counts[0]).filter(|&mm| mm < 8190).collect();
            valid.sort_unstable();
            let median_mm = f64::from(valid[valid.len() / 2]);
            assert!((median_mm - shot.pose.range_mm()).abs() < 1e-9, "{place}: {median_mm} mm");
        }
    }
}

#[test]
fn packets_start_8_s_apart_and_the_worn_head_moves_between_images() {
    let (_keep, root) = study(Options::default().seed);
    let bench = decode(&root.join("cards/bench-35cm-55deg"), "ACC", 4);
    assert!((bench[1022].0 - bench[0].0 - 8.0).abs() < 1e-6);
    assert!((bench[1022].0 - bench[1021].0 - 3.0 / 128.0).abs() < 1e-6, "16 ms are missing");

    let worn = all_sessions().into_iter().find(|session| session.name == "worn-white-box").unwrap();
    let samples = decode(&root.join("cards/worn-white-box"), "ACC", 4);
    let between_s = worn.start.plus_seconds(worn.shots[0].time_s + 5.0).seconds_since(model::UtcNs(0));
    let moving_mg = motion_mg(&around(&samples, between_s, 1.0));
    assert!(moving_mg > 50.0, "{moving_mg} mg");
}

#[test]
fn range_records_hold_readings_and_lose_a_few() {
    let (_keep, root) = study(Options::default().seed);
    let mut counts: Vec<i16> =
        decode(&root.join("cards/bench-50cm-41deg"), "RNG", 1).into_iter().map(|(_, counts)| counts[0]).collect();
    let lost = counts.iter().filter(|&&count| count == 8190).count();
    assert!((1..counts.len() / 20).contains(&lost), "{lost} of {}", counts.len());
    let samples = counts.len();
    counts.dedup();
    assert!((3 * counts.len()..9 * counts.len()).contains(&samples), "{} changes in {samples} samples", counts.len());
}
