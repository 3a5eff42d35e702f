//! Tables with square and rectangular plates, and without, as scene files drawn by lot.

use std::fmt::Write as _;

/// Poses of each table.
const POSES: u32 = 3;

/// The things on a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Set {
    /// A rectangular plate, and other things.
    Plates,
    /// Flat and rectangular things that are no plates, boxes, round plates and bowls.
    Others,
}

/// A sequence of numbers that follows from its seed (SplitMix64: Steele, Lea, Flood 2014).
struct Lot(u64);

impl Lot {
    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.share()
    }

    fn is(&mut self, chance: f64) -> bool {
        self.share() < chance
    }

    fn colour(&mut self) -> String {
        let [r, g, b] = [(); 3].map(|()| self.between(0.05, 0.85));
        format!("[{r:.2}, {g:.2}, {b:.2}]")
    }

    fn turn(&mut self) -> f64 {
        self.between(-50.0, 50.0)
    }
}

/// The scene file of one table.
pub fn scene(set: Set, seed: u64, number: u64) -> String {
    let mut lot = Lot(seed.wrapping_mul(1_000_003).wrapping_add(number));
    lot.share();
    let mut text = "schema_version = 1\nname = \"squares\"\ncamera = \"aim2-raw\"\n".to_owned();
    let middle = [lot.between(-60.0, 60.0), lot.between(270.0, 350.0)];
    match set {
        Set::Plates => plate(&mut text, &mut lot, middle),
        Set::Others => other(&mut text, &mut lot, middle),
    }
    beside(&mut text, &mut lot, middle);
    let _ = writeln!(text, "[[sessions]]\nname = \"table\"\nposes = [");
    for _ in 0..POSES {
        let (pitch, height) = (lot.between(38.0, 75.0), lot.between(360.0, 520.0));
        let (roll, yaw) = (lot.between(-7.0, 7.0), lot.between(-25.0, 25.0));
        let aim = middle.map(|m| m + lot.between(-50.0, 50.0));
        let _ = writeln!(
            text,
            "  {{ pitch_deg = {pitch:.2}, height_mm = {height:.1}, roll_deg = {roll:.2}, yaw_deg = {yaw:.2}, \
             aim_mm = [{:.1}, {:.1}] }},",
            aim[0], aim[1]
        );
    }
    text + "]\n"
}

/// A plate, with food on it every third time, and a mat below it every fourth time.
fn plate(text: &mut String, lot: &mut Lot, [x, y]: [f64; 2]) {
    let long = lot.between(130.0, 310.0);
    let turn = lot.turn();
    let is_square = lot.is(0.5);
    let wide = if is_square { long.min(270.0) } else { (long * lot.between(0.45, 0.9)).max(80.0) };
    if lot.is(0.25) {
        let (w, h) = (long + lot.between(50.0, 120.0), wide + lot.between(50.0, 120.0));
        let colour = lot.colour();
        let turn = turn + lot.between(-6.0, 6.0);
        let _ = writeln!(
            text,
            "[[napkins]]\nat_mm = [{x:.1}, {y:.1}]\nsize_mm = [{w:.1}, {h:.1}]\nturn_deg = {turn:.1}\ncolour = {colour}"
        );
    }
    let sides = if is_square {
        format!("width_mm = {wide:.1}")
    } else {
        format!("width_mm = {wide:.1}\nlength_mm = {long:.1}")
    };
    let outer = if is_square { wide } else { long };
    let flange = wide * lot.between(0.09, 0.2);
    let (well, height) = (outer - 2.0 * flange, lot.between(13.0, 34.0));
    let food = if lot.is(0.34) { lot.between(15.0, 75.0) } else { 0.0 };
    let _ = writeln!(
        text,
        "[[plates]]\nname = \"plate\"\nat_mm = [{x:.1}, {y:.1}]\nturn_deg = {turn:.1}\n{sides}\nwell_mm = {well:.1}\n\
         height_mm = {height:.1}\nthickness_mm = {:.1}\nfood_pct = {food:.0}",
        lot.between(2.5, 4.0)
    );
}

/// Mats, boxes, a round plate or a bowl, one or two of them.
fn other(text: &mut String, lot: &mut Lot, [x, y]: [f64; 2]) {
    let kind = lot.share();
    if kind < 0.6 {
        let (w, h) = (lot.between(90.0, 420.0), lot.between(90.0, 300.0));
        let (turn, colour) = (lot.turn(), lot.colour());
        let _ = writeln!(
            text,
            "[[napkins]]\nat_mm = [{x:.1}, {y:.1}]\nsize_mm = [{w:.1}, {h:.1}]\nturn_deg = {turn:.1}\ncolour = {colour}"
        );
        if lot.is(0.4) {
            let share = lot.between(0.6, 0.9);
            let colour = lot.colour();
            let _ = writeln!(
                text,
                "[[napkins]]\nat_mm = [{x:.1}, {y:.1}]\nsize_mm = [{:.1}, {:.1}]\nturn_deg = {turn:.1}\ncolour = {colour}",
                w * share,
                h * share
            );
        }
    }
    let diameter = lot.between(110.0, 280.0);
    if (0.4..0.8).contains(&kind) {
        let _ = writeln!(
            text,
            "[[plates]]\nname = \"round\"\nat_mm = [{x:.1}, {y:.1}]\ndiameter_mm = {diameter:.1}\nfood_pct = 30"
        );
    } else if kind >= 0.8 {
        let (wide, high) = (lot.between(80.0, 160.0), lot.between(25.0, 90.0));
        let long = wide * lot.between(1.0, 1.8);
        let turn = lot.turn();
        let _ = writeln!(
            text,
            "[[boxes]]\nname = \"box\"\nat_mm = [{x:.1}, {y:.1}]\nlength_mm = {long:.1}\nwidth_mm = {wide:.1}\n\
             height_mm = {high:.1}\nturn_deg = {turn:.1}"
        );
    }
}

/// Cutlery, a glass, a napkin, a telephone, a hand: each now and then.
fn beside(text: &mut String, lot: &mut Lot, [x, y]: [f64; 2]) {
    let side = if lot.is(0.5) { 1.0 } else { -1.0 };
    let at = |out: f64, lot: &mut Lot| [x + side * (out + lot.between(0.0, 60.0)), y + lot.between(-100.0, 80.0)];
    for kind in ["fork", "knife"] {
        let [u, v] = at(165.0, lot);
        if lot.is(0.5) {
            let _ = writeln!(
                text,
                "[[cutlery]]\nkind = \"{kind}\"\nat_mm = [{u:.1}, {:.1}]\nturn_deg = {:.1}",
                v - 90.0,
                lot.between(70.0, 110.0)
            );
        }
    }
    let [u, v] = at(200.0, lot);
    if lot.is(0.4) {
        let _ = writeln!(text, "[[glasses]]\nat_mm = [{u:.1}, {v:.1}]");
    }
    let [u, v] = at(-320.0, lot);
    let kind = lot.share();
    if kind < 0.25 {
        let (turn, colour) = (lot.turn(), lot.colour());
        let _ = writeln!(text, "[[napkins]]\nat_mm = [{u:.1}, {v:.1}]\nturn_deg = {turn:.1}\ncolour = {colour}");
    } else if kind < 0.5 {
        let _ = writeln!(text, "[[telephones]]\nat_mm = [{u:.1}, {v:.1}]\nturn_deg = {:.1}", lot.turn());
    }
    if lot.is(0.2) {
        let (tip, reach) = (lot.between(60.0, 130.0), lot.between(20.0, 90.0));
        let _ = writeln!(
            text,
            "[[hands]]\ntip_mm = [{:.1}, {:.1}, 50]\nelbow_mm = [{:.1}, -30, 60]",
            x + side * tip,
            y - reach,
            x + side * 300.0
        );
    }
}
