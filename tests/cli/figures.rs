//! `volary figures`.

use crate::scene::Scene;

#[test]
fn makes_what_is_asked_for_and_pages_that_show_it() {
    let scene = Scene::new();
    let said = scene.succeeds("figures out --only olfati-saber-2003-4 --only olfati-saber-2003-2");
    for says in [
        "olfati-saber-2003-2\n",
        "Paper: (a) A bump function",
        "Ours: ρ leaves 1 at z = 10",
        "index.html",
    ] {
        assert!(said.contains(says), "{says}: {said}");
    }
    assert!(!said.contains("olfati-saber-2003-5"), "{said}");
    for name in ["olfati-saber-2003-2.svg", "olfati-saber-2003-4.svg"] {
        assert!(scene.bytes(&format!("out/{name}")).starts_with(b"<svg"));
        for page in ["index.html", "index.md"] {
            let text = String::from_utf8(scene.bytes(&format!("out/{page}"))).unwrap();
            assert!(text.contains(name), "{page} lacks {name}");
            assert!(text.contains("Sketches"), "{page}");
            assert!(!text.contains("Djokam"), "{page}");
        }
    }
    let files = std::fs::read_dir(scene.path("out")).unwrap().count();
    assert_eq!(files, 4);

    let quiet = "figures dark --only olfati-saber-2003-4 --format png --theme dark --quiet";
    assert_eq!(scene.succeeds(quiet), "");
    assert!(
        scene
            .bytes("dark/olfati-saber-2003-4.png")
            .starts_with(b"\x89PNG")
    );
}

#[test]
fn the_same_figures_have_the_same_bytes() {
    let scene = Scene::new();
    for folder in ["a", "b"] {
        scene.succeeds(&format!("figures {folder} --only olfati-saber-2003-5"));
    }
    for name in ["olfati-saber-2003-5.svg", "index.html"] {
        let [a, b] = ["a", "b"].map(|folder| scene.bytes(&format!("{folder}/{name}")));
        assert!(a == b, "{name}");
    }
}

#[test]
fn existing_files_are_kept_unless_forced() {
    let scene = Scene::new();
    std::fs::create_dir(scene.path("out")).unwrap();
    let figures = "figures out --only olfati-saber-2003-2";
    for name in ["out/index.md", "out/olfati-saber-2003-2.svg"] {
        scene.put(name, "precious");
        scene.fails(figures, 2, &[name, "exists already", "--force"]);
        let files = std::fs::read_dir(scene.path("out")).unwrap().count();
        assert_eq!((scene.bytes(name), files), (b"precious".to_vec(), 1));
        std::fs::remove_file(scene.path(name)).unwrap();
    }
    scene.put("out/other.txt", "precious");
    scene.put("out/index.html", "old");
    scene.succeeds(&format!("{figures} --force"));
    assert_eq!(scene.bytes("out/other.txt"), b"precious");
    assert_ne!(scene.bytes("out/index.html"), b"old");
}

#[test]
fn refuses_what_it_does_not_know_and_where_it_cannot_write() {
    let scene = Scene::new();
    scene.fails(
        "figures out --only olfati-saber-2003-22",
        2,
        &[
            "olfati-saber-2003-22: no figure",
            "did you mean olfati-saber-2003-2?",
        ],
    );
    scene.fails("figures out --only vicsek", 2, &["vicsek", "--list"]);
    scene.put("file", "precious");
    let mut unfit = vec![("file", "file: this is no folder"), ("file/in", "file/in")];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("nowhere", scene.path("file-link")).unwrap();
        unfit.push(("file-link", "file-link: this is no folder"));
    }
    for (folder, problem) in &unfit {
        for force in ["", " --force"] {
            let figures = format!("figures {folder} --only olfati-saber-2003-2{force}");
            scene.fails(&figures, 2, &[problem]);
        }
    }
    scene.fails("figures", 2, &["OUTDIR"]);
    assert_eq!(scene.names().len(), unfit.len() - 1);
    assert_eq!(scene.bytes("file"), b"precious");
}

#[test]
fn lists_what_can_be_made_and_what_cannot() {
    let said = Scene::new().succeeds("figures --list");
    for says in [
        "djokam-rathinam-8-corrected\n",
        "shi-wang-chu-7\n",
        "Sketches, which show no result:",
        "Figure 6",
    ] {
        assert!(said.contains(says), "{says}: {said}");
    }
    let some = Scene::new().succeeds("figures --list --only li-liu-wu");
    assert_eq!(some.matches("Paper:").count(), 4, "{some}");
    assert!(!some.contains("Sketches"), "{some}");
}
