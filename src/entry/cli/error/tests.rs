use super::*;

fn problem(text: &str, needle: &str) -> Problem {
    let start = text.find(needle).expect("there");
    let line = text[..start].matches('\n').count() + 1;
    let column = text[..start].chars().rev().take_while(|c| *c != '\n').count() + 1;
    Problem {
        code: Code::Negative,
        path: "blocks[1].weight".into(),
        line,
        column,
        span: Some(start..start + needle.len()),
        message: "a weight of -3 N".into(),
        help: "give 0 or more".into(),
        place: None,
    }
}

fn shown(text: &str, list: &[Problem]) -> String {
    shown_within(text, list, None)
}

fn shown_within(text: &str, list: &[Problem], width: Option<usize>) -> String {
    let mut plain = String::new();
    let mut escaped = false;
    for c in all("a.json", Some(text), list, width).chars() {
        match (escaped, c) {
            (false, '\u{1b}') => escaped = true,
            (true, 'm') => escaped = false,
            (true, _) => {}
            (false, c) => plain.push(c),
        }
    }
    plain
}

#[test]
fn a_problem_is_shown_with_its_line_and_position() {
    let text = "{\n  \"é\": 1,\n  \"weight\": -3\n}";
    let shown = shown(text, &[problem(text, "-3")]);
    assert!(shown.contains("a.json:3:13"), "{shown}");
    assert!(shown.contains("3 │   \"weight\": -3"), "{shown}");
    assert!(shown.contains("blocks[1].weight") && shown.contains("give 0 or more"), "{shown}");
}

#[test]
fn a_long_line_is_shown_around_the_problem_only() {
    let text = format!("{{ {}\"weight\": -3 {} }}", "\"x\": 1, ".repeat(500), ", \"y\": 2".repeat(500));
    let shown = shown(&text, &[problem(&text, "-3")]);
    assert!(shown.len() < 400, "{shown}");
    let lines: Vec<&str> = shown.lines().collect();
    let caret = lines[2].find('^').expect("marked");
    let column = lines[1].char_indices().position(|(i, _)| i == lines[1].find("-3").expect("shown")).expect("there");
    assert_eq!(caret, column, "{shown}");
}

/// Long lines, wide letters, long paths and long help, on terminals of 40 columns and more.
#[test]
fn a_problem_fits_the_terminal_and_is_marked_at_its_position() {
    let lines = [
        "{ \"weight\": -3 }".to_owned(),
        format!("{{ \"{}\": 1, \"weight\": -3, \"x\": [{}] }}", "石材".repeat(12), "0, ".repeat(30)),
        format!("{}\"weight\": -3", " ".repeat(70)),
        format!("\"weight\": -3{}", ", \"y\": 2".repeat(500)),
    ];
    for text in lines {
        let text = format!("\n\n{text}\n");
        let mut wrong = problem(&text, "-3");
        wrong.path = "steps[12].hold.a robot of many words.at".into();
        wrong.help = "known keys are ".to_owned() + &"contact_tolerance, ".repeat(12);
        for width in [40, 60, 79, 200] {
            let shown = shown_within(&text, std::slice::from_ref(&wrong), Some(width));
            let mut page = Page::default();
            page.block(&shown);
            let lines: Vec<&str> = shown.lines().collect();
            let piece = lines.iter().position(|l| l.contains("-3") && !l.contains("N"));
            let piece = piece.unwrap_or_else(|| panic!("{width}: {shown}"));
            assert!(seen(lines[piece]) <= width, "{width}: {shown}");
            let place = lines[piece].find("-3").map(|at| seen(&lines[piece][..at]));
            let mark = lines[piece + 1].find(['^', '┬']).map(|at| seen(&lines[piece + 1][..at]));
            let off = mark.zip(place).map(|(mark, place)| mark.abs_diff(place));
            // ariadne draws the arrow from the middle of the marked text.
            assert!(off <= Some(1) && off.is_some(), "{width}: {shown}");
            for line in page.fitted(width).text().lines() {
                assert!(seen(line) <= width, "{width}: {line}");
            }
        }
    }
}

#[test]
fn thirty_problems_are_shown_and_the_rest_is_counted() {
    let text = "{ \"weight\": -3 }";
    let different = |i: usize| Problem { help: format!("give {i} or more"), ..problem(text, "-3") };
    let list: Vec<Problem> = (0..42).map(different).collect();
    assert!(shown(text, &list).ends_with("... and 12 more in a.json\n"));
    // Problems of one kind are one message.
    let alike = vec![problem(text, "-3"); 42];
    let found = shown(text, &alike);
    assert!(found.contains("... and 41 more problems of this kind, at blocks[1].weight"), "{found}");
    assert_eq!(found.matches("a weight of -3 N").count(), 1, "{found}");
}

#[test]
fn spans_at_the_end_of_the_text_or_beyond_it_cause_no_panic() {
    let text = "{\n\"ä\":\n";
    for (start, end) in [(0, 0), (7, 7), (8, 8), (9, 12), (4, 5), (0, 9), (3, 3), (100, 3)] {
        let mut wrong = problem("-3", "-3");
        wrong.span = Some(start..end);
        assert!(shown(text, &[wrong]).contains("a weight of -3 N"), "{start}..{end}");
    }
}
