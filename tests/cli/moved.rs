//! `crossbar prt`, the command that three systems had together: where each verb went.

use crate::{crossbar, tree};

#[test]
fn the_old_name_says_where_each_verb_went() {
    let verbs = [
        ("bicluster", "`crossbar bi-scale bicluster`"),
        ("card x.prt", "`crossbar cpca card` or `crossbar all-frequency card` or `crossbar bi-scale card`"),
        ("compare", "`crossbar bi-scale compare`"),
        ("compress --clusters 3", "`crossbar cpca compress` or `crossbar all-frequency compress`"),
        ("error a b --help", "`crossbar cpca error` or `crossbar all-frequency error`"),
        ("factor --brdf phong", "`crossbar all-frequency factor`"),
        ("lighting", "`crossbar all-frequency lighting`"),
        ("multiply", "`crossbar bi-scale multiply`"),
        ("precompute x.obj --kind glossy", "is now `crossbar cpca precompute`"),
        ("precompute --kind=all-frequency x.obj", "is now `crossbar all-frequency precompute`"),
        ("precompute --kind bi-scale", "is now `crossbar bi-scale precompute`"),
        ("show", "`crossbar cpca show` or `crossbar all-frequency show` or `crossbar bi-scale show`"),
        ("texture", "`crossbar bi-scale texture`"),
        ("", "a command for each system: `crossbar cpca`, `crossbar all-frequency` and `crossbar bi-scale`"),
        ("--json", "a command for each system"),
    ];
    for (arguments, words) in verbs {
        let arguments: Vec<&str> = ["prt"].into_iter().chain(arguments.split_whitespace()).collect();
        let ran = crossbar(&arguments, "");
        assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "{}", ran.transcript());
        assert!(ran.stderr.contains(words), "{}", ran.transcript());
        for new in words.split('`').filter_map(|part| part.strip_prefix("crossbar ")).filter(|new| new.contains(' ')) {
            assert!(tree::commands().iter().any(|(name, _)| name == new), "{new}");
        }
    }
    let json = crossbar(&["prt", "multiply", "--json"], "");
    let said: serde_json::Value = serde_json::from_str(&json.stderr).expect("one JSON document");
    assert!(said["message"].as_str().is_some_and(|message| message.contains("`crossbar bi-scale multiply`")), "{said}");
}

/// The name is nowhere to be found: not in help, completions or manual pages.
#[test]
fn the_old_name_is_not_offered() {
    assert!(tree::commands().iter().all(|(name, _)| !name.starts_with("prt")));
    assert!(!crossbar(&["--help"], "").stdout.contains(" prt "));
    assert!(!crate::completions::completed(&["p"]).contains("prt"));
}
