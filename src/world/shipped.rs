//! The worlds that come with the program.

use include_dir::{Dir, include_dir};

use super::words;

static WORLDS: Dir = include_dir!("$CARGO_MANIFEST_DIR/worlds");

/// The names of all shipped worlds, sorted: `olfati-saber-2003/six-obstacles`.
pub fn names() -> Vec<String> {
    let mut names = Vec::new();
    collect(&WORLDS, &mut names);
    names.sort();
    names
}

/// The text of a shipped world.
pub fn get(name: &str) -> Option<&'static str> {
    WORLDS.get_file(format!("{name}.json"))?.contents_utf8()
}

/// The shipped world whose name is nearest to one that does not exist, if any is
/// near enough, or is what the given name is a part of.
pub fn nearest(name: &str) -> Option<String> {
    let name = name.trim_start_matches("worlds/").trim_end_matches(".json");
    let names = names();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    words::nearest_path(name, &names).map(str::to_owned)
}

fn collect(folder: &Dir, names: &mut Vec<String>) {
    for file in folder.files() {
        let name = file
            .path()
            .to_str()
            .and_then(|path| path.strip_suffix(".json"));
        names.extend(name.map(|name| name.replace('\\', "/")));
    }
    for folder in folder.dirs() {
        collect(folder, names);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_what_it_gets() {
        let names = names();
        assert!(names.contains(&"olfati-saber-2003/six-obstacles".to_owned()));
        assert!(names.is_sorted());
        assert!(names.iter().all(|name| get(name).is_some()));
        assert_eq!(get("olfati-saber-2003/none"), None);
    }

    #[test]
    fn guesses_what_was_meant() {
        let meant = Some("olfati-saber-2003/six-obstacles".to_owned());
        assert_eq!(nearest("olfati-saber-2003/six-obstacle"), meant);
        assert_eq!(
            nearest("worlds/olfati-saber-2003/six-obstacles.json"),
            meant
        );
        assert_eq!(nearest("six-obstacles"), meant);
        assert_eq!(nearest("six-obstakles"), meant);
        assert_eq!(nearest("vicsek"), None);
        assert_eq!(nearest(""), None);
    }
}
