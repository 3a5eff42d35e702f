//! Decides which picture of the study an image of another tool is.

use std::collections::BTreeMap;

use ingest::card::{Card, Patterns};
use ingest::nfc;

use crate::session::Prepared;
use crate::study::{SessionDir, Study, stem_of};

/// A session whose pictures may be marked.
pub(super) struct MarkedSession<'a> {
    pub dir: &'a SessionDir,
    /// The session before its card is read, or the reason why it cannot be used.
    pub prepared: Result<Prepared, String>,
}

/// A picture of a card.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Picture {
    /// The number of its session in [`Pictures::sessions`].
    pub session: usize,
    /// The file on the card.
    pub file: String,
}

/// The pictures of a study, by the names that marks have.
#[derive(Default)]
pub(super) struct Pictures<'a> {
    pub sessions: Vec<MarkedSession<'a>>,
    by_stem: BTreeMap<String, Vec<Picture>>,
    count: usize,
}

impl<'a> Pictures<'a> {
    /// The pictures of all sessions, or of one. A fault of a card shows when one of its pictures is asked for.
    pub fn list(study: &'a Study, only: Option<&str>, program: &str) -> Self {
        let mut pictures = Self::default();
        let patterns = study.profile.images.as_ref().and_then(|images| Patterns::new(&images.files).ok());
        let sessions =
            study.sessions.iter().filter(|dir| dir.card.is_some() && only.is_none_or(|only| dir.name == only));
        for dir in sessions {
            let mut prepared = Prepared::new(study, dir, program).map_err(|problem| problem.fact);
            if let (Ok(_), Some(card), Some(patterns)) = (&prepared, &dir.card, &patterns) {
                match Card::list(card) {
                    Ok(card) => card.fitting(patterns).into_iter().for_each(|file| pictures.add(file.name)),
                    Err(error) => prepared = Err(format!("its card cannot be listed: {error}")),
                }
            }
            pictures.sessions.push(MarkedSession { dir, prepared });
        }
        pictures
    }

    /// Adds a picture of the session that is pushed next.
    fn add(&mut self, file: String) {
        let session = self.sessions.len();
        self.by_stem.entry(stem_of(&file)).or_default().push(Picture { session, file });
        self.count += 1;
    }

    /// The picture that a name with folders means. If several have the name, it is the one in the session that a folder of
    /// the name is called after, else the one whose own folders agree best.
    ///
    /// # Errors
    /// A text, where there is none, or several.
    pub fn find(&self, name: &str) -> Result<&Picture, String> {
        let name = nfc(name.replace('\\', "/"));
        let mut parts: Vec<&str> = name.split('/').filter(|part| !matches!(*part, "" | ".")).collect();
        let of_name = self.of_name(parts.pop().unwrap_or_default());
        let named: Vec<usize> = (0..self.sessions.len()).filter(|at| parts.contains(&self.session_name(*at))).collect();
        let in_named = |picture: &&Picture| named.is_empty() || named.contains(&picture.session);
        let candidates: Vec<&Picture> = of_name.iter().filter(in_named).collect();
        let agreement = |picture: &Picture| {
            let own = picture.file.rsplit('/').skip(1).chain([self.session_name(picture.session)]);
            own.zip(parts.iter().rev()).take_while(|(own, part)| own == *part).count()
        };
        let most = candidates.iter().map(|picture| agreement(picture)).max();
        let best: Vec<&Picture> = candidates.into_iter().filter(|picture| Some(agreement(picture)) == most).collect();
        match best.as_slice() {
            [picture] => self.unless_same_stem(picture, of_name),
            [] => Err(self.not_found(&named, of_name)),
            [first, rest @ ..] if rest.iter().all(|other| other.session == first.session) => {
                self.unless_same_stem(first, of_name)
            }
            several => {
                let several = self.listed(several);
                Err(format!("it may be any of: {several}; name the session in its path, or give --session"))
            }
        }
    }

    /// The pictures of this name, whatever the extension, which may be another, or missing.
    fn of_name(&self, name: &str) -> &[Picture] {
        let of_stem = self.by_stem.get(&stem_of(name)).or_else(|| self.by_stem.get(name));
        of_stem.map(Vec::as_slice).unwrap_or_default()
    }

    /// The picture of a session that a file of marks belongs to.
    ///
    /// # Errors
    /// A text, where there is none, or several.
    pub fn of_marks(&self, session: usize, stem: &str) -> Result<&Picture, String> {
        let of_stem = self.by_stem.get(stem).map(Vec::as_slice).unwrap_or_default();
        let picture = of_stem.iter().find(|picture| picture.session == session);
        picture
            .ok_or_else(|| "the card has no image of this name".to_owned())
            .and_then(|p| self.unless_same_stem(p, of_stem))
    }

    /// Marks have the name of their image without its extension, within a session.
    fn unless_same_stem<'p>(&'p self, picture: &'p Picture, of_name: &[Picture]) -> Result<&'p Picture, String> {
        let same: Vec<&Picture> = of_name.iter().filter(|other| other.session == picture.session).collect();
        if same.len() == 1 {
            return Ok(picture);
        }
        let all = self.listed(&same);
        Err(format!(
            "several images of one session have this name, but for folder and extension: {all}; rename all but one"
        ))
    }

    fn not_found(&self, named: &[usize], of_name: &[Picture]) -> String {
        let broken = named.iter().find_map(|at| {
            let session = self.sessions.get(*at)?;
            session.prepared.as_ref().err().map(|fact| format!("session '{}' cannot be used: {fact}", session.dir.name))
        });
        if let Some(broken) = broken {
            return broken;
        }
        if of_name.is_empty() {
            let (count, sessions) = (self.count, self.sessions.len());
            let first =
                self.by_stem.values().flatten().min().map(|picture| format!(", the first is {}", self.place(picture)));
            return format!(
                "no card has an image of this name ({count} images of {sessions} sessions{})",
                first.unwrap_or_default()
            );
        }
        let others = self.listed(&of_name.iter().collect::<Vec<_>>());
        format!("the session that its path names has no such image; others have: {others}")
    }

    fn listed(&self, pictures: &[&Picture]) -> String {
        const MOST: usize = 5;
        let listed = pictures.iter().take(MOST).map(|picture| self.place(picture)).collect::<Vec<_>>().join(", ");
        match pictures.len().saturating_sub(MOST) {
            0 => listed,
            more => format!("{listed} and {more} more"),
        }
    }

    /// The place of a picture: `SESSION/FILE`.
    pub fn place(&self, picture: &Picture) -> String {
        format!("{}/{}", self.session_name(picture.session), picture.file)
    }

    fn session_name(&self, at: usize) -> &str {
        self.sessions.get(at).map(|session| session.dir.name.as_str()).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    fn place_of(cards: &[(&str, &[&str])], name: &str) -> Result<String, String> {
        let dirs: Vec<SessionDir> = cards.iter().map(|(session, _)| SessionDir::new(session)).collect();
        let mut pictures = Pictures::default();
        for (dir, (_, files)) in dirs.iter().zip(cards) {
            files.iter().for_each(|file| pictures.add((*file).to_owned()));
            pictures.sessions.push(MarkedSession { dir, prepared: Err("broken".to_owned()) });
        }
        pictures.find(name).map(|picture| pictures.place(picture))
    }

    #[test]
    fn a_name_with_or_without_folders() {
        let cards: &[(&str, &[&str])] = &[("S1", &["images/a.jpg", "images/b.jpg"]), ("S2", &["images/a.jpg"])];
        for (name, expected) in [
            ("b.jpg", "S1/images/b.jpg"),
            ("b.png", "S1/images/b.jpg"),
            ("S1/b", "S1/images/b.jpg"),
            ("S2/a.jpg", "S2/images/a.jpg"),
            (r"study\cards\S1\images\a.jpg", "S1/images/a.jpg"),
            ("./images/b.jpg", "S1/images/b.jpg"),
            ("other/b.jpg", "S1/images/b.jpg"),
        ] {
            assert_eq!(place_of(cards, name).as_deref(), Ok(expected), "{name}");
        }
    }

    #[test]
    fn a_name_in_either_unicode_form() {
        let cards: &[(&str, &[&str])] = &[("m\u{fc}ller", &["I/k\u{e4}se.jpg"]), ("S2", &["I/k\u{e4}se.jpg"])];
        let found = place_of(cards, "mu\u{308}ller/ka\u{308}se.jpg");
        assert_eq!(found.as_deref(), Ok("m\u{fc}ller/I/k\u{e4}se.jpg"));
    }

    #[test]
    fn what_is_not_clear_is_not_guessed() {
        let cards: &[(&str, &[&str])] =
            &[("S1", &["images/a.jpg", "c.jpg", "c.png"]), ("S2", &["images/a.jpg", "b.jpg"]), ("S3", &[])];
        for (name, expected) in [
            ("a.jpg", "S1/images/a.jpg, S2/images/a.jpg"),
            ("images/a.jpg", "may be any of"),
            ("S1/S2/a.jpg", "may be any of"),
            ("S3/b.jpg", "session 'S3' cannot be used: broken"),
            ("d.jpg", "no card has an image of this name (5 images of 3 sessions, the first is S1/c.jpg)"),
            ("S1/c.jpg", "several images of one session"),
            ("", "no card has an image"),
        ] {
            let fact = place_of(cards, name).unwrap_err();
            assert!(fact.contains(expected), "{name}: {fact}");
        }
    }

    #[test]
    fn the_folder_that_agrees_best_decides() {
        let cards: &[(&str, &[&str])] = &[("S1", &["left/a.jpg"]), ("S2", &["right/a.jpg"])];
        assert_eq!(place_of(cards, "right/a.jpg").as_deref(), Ok("S2/right/a.jpg"));
    }
}
