//! Decides which picture of the study an image of another tool is.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use ingest::card::{Card, Patterns};
use ingest::nfc;

use super::changed_names::{Change, all_words, decoded, names_before, words_of};
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
    by_words: OnceCell<BTreeMap<String, Vec<Picture>>>,
    count: usize,
}

/// A picture that an image may be, and how a tool changed its name.
struct Candidate<'a> {
    picture: &'a Picture,
    change: Option<Change>,
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

    /// The picture that a name with folders means, and how a tool changed the name. If several have the name, it is the one in the
    /// session that a folder of the name is called after, else the one whose own folders agree best.
    ///
    /// # Errors
    /// A text, where there is none, or several.
    pub fn find(&self, name: &str) -> Result<(&Picture, Option<Change>), String> {
        let name = nfc(name.replace('\\', "/"));
        match self.find_decoded(&name) {
            // Folders of a web address are one word, in which the '/' between them is changed as well.
            Err(fact) if name.contains("%2F") || name.contains("%2f") => match decoded(&name) {
                Some(name) => self.find_decoded(&name).map(|(picture, _)| (picture, Some(Change::Percent))),
                None => Err(fact),
            },
            found => found,
        }
    }

    fn find_decoded(&self, name: &str) -> Result<(&Picture, Option<Change>), String> {
        let mut parts: Vec<&str> = name.split('/').filter(|part| !matches!(*part, "" | ".")).collect();
        let of_name = self.of_name(parts.pop().unwrap_or_default());
        let named: Vec<usize> = (0..self.sessions.len()).filter(|at| parts.contains(&self.session_name(*at))).collect();
        let in_named = |candidate: &&Candidate<'_>| named.is_empty() || named.contains(&candidate.picture.session);
        let candidates: Vec<&Candidate<'_>> = of_name.iter().filter(in_named).collect();
        let agreement = |candidate: &Candidate<'_>| {
            let picture = candidate.picture;
            let own = picture.file.rsplit('/').skip(1).chain([self.session_name(picture.session)]);
            own.zip(parts.iter().rev()).take_while(|(own, part)| own == *part).count()
        };
        let most = candidates.iter().map(|candidate| agreement(candidate)).max();
        let best: Vec<&Candidate<'_>> =
            candidates.into_iter().filter(|candidate| Some(agreement(candidate)) == most).collect();
        let [first, rest @ ..] = best.as_slice() else { return Err(self.not_found(&named, &of_name)) };
        let is_same_name = |other: &&Candidate<'_>| stem_of(&other.picture.file) == stem_of(&first.picture.file);
        if rest.iter().any(|other| other.picture.session != first.picture.session || !is_same_name(other)) {
            let several = self.listed(&best.iter().map(|candidate| candidate.picture).collect::<Vec<_>>());
            return Err(format!("it may be any of: {several}; name the session in its path, or give --session"));
        }
        let picture = self.of_marks(first.picture.session, &stem_of(&first.picture.file))?;
        let is_elsewhere = !parts.is_empty() && most == Some(0) && named.is_empty();
        let picture = if rest.is_empty() { first.picture } else { picture };
        Ok((picture, first.change.or(is_elsewhere.then_some(Change::Folders))))
    }

    /// The pictures of this name, whatever the extension, which may be another, or missing; and those whose name a tool may have
    /// changed into this one.
    fn of_name(&self, name: &str) -> Vec<Candidate<'_>> {
        let of_stem = |stem: &str| self.by_stem.get(stem).map(Vec::as_slice).unwrap_or_default();
        let stems = [stem_of(name), name.to_owned()];
        let mut exact: Vec<Candidate<'_>> = Vec::new();
        if let Some(pictures) = stems.iter().map(|stem| of_stem(stem)).find(|pictures| !pictures.is_empty()) {
            exact.extend(pictures.iter().map(|picture| Candidate { picture, change: None }));
        }
        let before: Vec<(String, Change)> = stems.iter().flat_map(|stem| names_before(stem)).collect();
        for (stem, change) in &before {
            let new = of_stem(stem).iter().filter(|picture| exact.iter().all(|known| known.picture != *picture));
            let new: Vec<_> = new.map(|picture| Candidate { picture, change: Some(*change) }).collect();
            exact.extend(new);
        }
        if !exact.is_empty() {
            return exact;
        }
        let mut alike: BTreeMap<&Picture, Change> = BTreeMap::new();
        let [stem, _] = &stems;
        for (name, change) in before.into_iter().chain([(stem.clone(), Change::Characters)]) {
            let pictures = self.by_words().get(&words_of(&name)).map(Vec::as_slice).unwrap_or_default();
            pictures.iter().for_each(|picture| {
                alike.entry(picture).or_insert(change);
            });
        }
        alike.into_iter().map(|(picture, change)| Candidate { picture, change: Some(change) }).collect()
    }

    /// The pictures by the words of the names that tools may give them, worked out where a name is not known as it is.
    fn by_words(&self) -> &BTreeMap<String, Vec<Picture>> {
        self.by_words.get_or_init(|| {
            let mut by_words: BTreeMap<String, Vec<Picture>> = BTreeMap::new();
            for picture in self.by_stem.values().flatten() {
                let mut folders: Vec<&str> = picture.file.split('/').collect();
                folders.pop();
                for words in all_words(self.session_name(picture.session), &stem_of(&picture.file), &folders) {
                    by_words.entry(words).or_default().push(picture.clone());
                }
            }
            by_words
        })
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

    fn not_found(&self, named: &[usize], of_name: &[Candidate<'_>]) -> String {
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
        let others = self.listed(&of_name.iter().map(|candidate| candidate.picture).collect::<Vec<_>>());
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
mod tests;
