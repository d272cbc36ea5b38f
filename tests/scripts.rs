//! The scripts before the program: in which grammar they are, and which browsers have what they use. The page names the
//! oldest browsers that open it in one line, to which this holds it.

use std::collections::BTreeSet;

use house::{Outcome, Trouble, root};

/// Major and minor version of Chrome (Edge is the same), Firefox and Safari.
type Versions = [(u32, u32); 3];

/// Words and signs that came to the language after 2009 (ES5): a browser without them runs nothing of the file.
const YOUNGER_THAN_ES5: [&str; 17] = [
    "let", "const", "class", "async", "await", "yield", "import", "export", "of", "super", "=>", "?.", "??", "...",
    "**", "`", "#",
];

/// The names of a browser that stop.js may use: there in Internet Explorer 10, or asked for before they are used.
const OLD: [&str; 47] = [
    "Infinity",
    "XMLHttpRequest",
    "accept",
    "addEventListener",
    "button",
    "cache",
    "clearTimeout",
    "defaultPrevented",
    "detail",
    "document",
    "event",
    "getAttribute",
    "getElementById",
    "getResponseHeader",
    "headers",
    "hidden",
    "id",
    "isComposing",
    "isContentEditable",
    "isTyped",
    "keepalive",
    "key",
    "keyCode",
    "length",
    "method",
    "onabort",
    "onerror",
    "onload",
    "onloadstart",
    "open",
    "parentNode",
    "preventDefault",
    "readOnly",
    "repeat",
    "send",
    "setAttribute",
    "setRequestHeader",
    "setTimeout",
    "status",
    "submit",
    "tagName",
    "target",
    "test",
    "textContent",
    "timeStamp",
    "type",
    "value",
];
/// The names that it uses where they are there: in a `try` of its own, or left by us.
const TRIED: [&str; 8] = ["fetch", "get", "ok", "then", "rrpBegan", "rrpHeard", "rrpStops", "window"];

/// The names that boot.js uses and some browser got since 2015, and since when. Everything else it uses is listed as
/// old.
const SINCE: [(&str, Versions); 11] = [
    ("??", [(80, 0), (72, 0), (13, 4)]),
    ("?.", [(80, 0), (74, 0), (13, 4)]),
    ("import", [(63, 0), (67, 0), (11, 1)]),
    // Outside of functions.
    ("await", [(89, 0), (89, 0), (15, 0)]),
    ("append", [(54, 0), (49, 0), (10, 0)]),
    ("timeout", [(103, 0), (100, 0), (16, 0)]),
    ("fetch", [(42, 0), (39, 0), (10, 1)]),
    ("signal", [(66, 0), (57, 0), (12, 1)]),
    // `20_000`
    ("_", [(75, 0), (70, 0), (13, 0)]),
    // `catch {`
    ("catch", [(66, 0), (58, 0), (11, 1)]),
    ("light-dark", [(123, 0), (120, 0), (17, 5)]),
];
/// The names that boot.js uses and all browsers have had since 2015.
const USUAL: [&str; 67] = [
    "AbortSignal",
    "CompileError",
    "Map",
    "Number",
    "Object",
    "String",
    "WebAssembly",
    "addEventListener",
    "body",
    "capture",
    "catch",
    "console",
    "createElement",
    "dataset",
    "defaultPrevented",
    "document",
    "documentElement",
    "error",
    "filter",
    "get",
    "getAttribute",
    "getElementById",
    "getItem",
    "head",
    "hidden",
    "href",
    "id",
    "includes",
    "isComposing",
    "key",
    "keyCode",
    "keys",
    "lang",
    "language",
    "languages",
    "localStorage",
    "location",
    "map",
    "module_or_path",
    "navigator",
    "ok",
    "panic",
    "querySelector",
    "rel",
    "reload",
    "remove",
    "repeat",
    "rrpBegan",
    "rrpHeard",
    "rrpPanic",
    "rrpWords",
    "sessionStorage",
    "setAttribute",
    "setItem",
    "setTimeout",
    "slice",
    "split",
    "startsWith",
    "stuck",
    "submit",
    "text",
    "textContent",
    "timeStamp",
    "title",
    "type",
    "unloaded",
    "window",
];

#[test]
fn stop_runs_in_browsers_of_2012() -> Outcome<()> {
    let tokens = tokens(&read("static/stop.js")?);
    let young: Vec<&str> = tokens.iter().map(String::as_str).filter(|token| YOUNGER_THAN_ES5.contains(token)).collect();
    assert!(young.is_empty(), "stop.js has what came after ES5: {young:?}");
    let bare = tokens.windows(2).any(|pair| pair[0] == "catch" && pair[1] != "(");
    assert!(!bare, "`catch` without a name came after ES5");
    let used: Vec<String> =
        used(&tokens).into_iter().filter(|name| !OLD.contains(&&**name) && !TRIED.contains(&&**name)).collect();
    assert!(used.is_empty(), "say in OLD or TRIED that stop.js may use {used:?}");
    Ok(())
}

#[test]
fn the_program_is_loaded_by_what_the_named_browsers_have() -> Outcome<()> {
    let named = named(&read("static/index.html")?)?;
    let tokens = tokens(&read("static/boot.js")?);
    let mut wrong = Vec::new();
    let styles = read("static/styles/tokens.css")?;
    let signs = tokens.iter().filter(|token| SINCE.iter().any(|(name, _)| name == token)).cloned();
    let styled = styles.contains("light-dark").then(|| "light-dark".to_owned());
    for name in used(&tokens).into_iter().chain(signs).chain(styled) {
        match SINCE.iter().find(|(known, _)| *known == name) {
            Some((_, since)) if (0..3).all(|browser| since[browser] <= named[browser]) => {}
            Some((_, since)) => wrong.push(format!("{name} came with {since:?}")),
            None if USUAL.contains(&&*name) => {}
            None => wrong.push(format!("since when is {name} there? Say so in SINCE or USUAL")),
        }
    }
    assert!(wrong.is_empty(), "the page names {named:?} as the oldest: {wrong:?}");
    Ok(())
}

#[test]
fn the_page_names_its_oldest_browsers_alike_wherever_it_does() -> Outcome<()> {
    let page = read("static/index.html")?;
    let [chrome, firefox, safari] = named(&page)?;
    let shown = |(major, minor): (u32, u32)| if minor == 0 { major.to_string() } else { format!("{major}.{minor}") };
    let all = [("Chrome", chrome), ("Edge", chrome), ("Firefox", firefox), ("Safari", safari)];
    let part =
        |from: &str, to: &str| page.split(from).nth(1).and_then(|rest| rest.split(to).next()).unwrap_or_default();
    let japanese = read("static/ja.txt")?;
    let after = |key: &str| japanese.split(&format!("\n{key}\n")).nth(1).and_then(|rest| rest.lines().next());
    let said = [
        part("id=\"unopened\"", "</p>"),
        part("<noscript>", "</noscript>"),
        after("stop.unopened").unwrap_or_default(),
        after("stop.scriptless").unwrap_or_default(),
    ];
    for said in said {
        for (browser, version) in all {
            let named = format!("{browser} {}", shown(version));
            assert_eq!(said.matches(&named).count(), 1, "{named}: {said}");
        }
    }
    Ok(())
}

/// The oldest browsers, as the page's first lines name them.
fn named(page: &str) -> Outcome<Versions> {
    let line = page.split("<meta name=\"browsers\" content=\"").nth(1).and_then(|rest| rest.split('"').next());
    let line = line.ok_or("index.html names no browsers.")?;
    let version = |browser: &str| -> Outcome<(u32, u32)> {
        let words: Vec<&str> = line.split([' ', ',']).collect();
        let at = words.iter().position(|word| *word == browser).ok_or(Trouble(format!("{browser} is not named.")))?;
        let (major, minor) = words[at + 1].split_once('.').unwrap_or((words[at + 1], "0"));
        Ok((major.parse()?, minor.parse()?))
    };
    assert_eq!(version("Chrome")?, version("Edge")?, "they are the same browser");
    Ok([version("Chrome")?, version("Firefox")?, version("Safari")?])
}

fn read(path: &str) -> Outcome<String> {
    Ok(std::fs::read_to_string(root().join(path))?)
}

/// Returns what a script asks of the browser: names of members and of what it does not make itself.
fn used(tokens: &[String]) -> BTreeSet<String> {
    let own = declared(tokens);
    let is_word = |token: &str| token.chars().next().is_some_and(|c| c.is_alphabetic() || c == '_' || c == '$');
    let is_member = |at: usize| at > 0 && matches!(tokens[at - 1].as_str(), "." | "?.");
    let names = tokens.iter().enumerate().filter(|(at, token)| {
        is_word(token) && (is_member(*at) || (!own.contains(*token) && !KEYWORDS.contains(&token.as_str())))
    });
    names.map(|(_, token)| token.clone()).collect()
}

const KEYWORDS: [&str; 29] = [
    "async",
    "await",
    "break",
    "const",
    "continue",
    "else",
    "export",
    "false",
    "for",
    "from",
    "function",
    "if",
    "import",
    "in",
    "instanceof",
    "let",
    "new",
    "null",
    "of",
    "return",
    "this",
    "throw",
    "true",
    "try",
    "typeof",
    "undefined",
    "var",
    "while",
    "catch",
];

/// Names that a script makes itself: variables, functions, and what these are given.
fn declared(tokens: &[String]) -> BTreeSet<String> {
    let mut own = BTreeSet::new();
    for (at, token) in tokens.iter().enumerate() {
        match token.as_str() {
            "const" if tokens.get(at + 1).is_some_and(|next| next == "{") => {
                own.extend(tokens[at + 2..].iter().take_while(|token| *token != "}").cloned());
            }
            "var" | "let" | "const" | "function" => own.extend(tokens.get(at + 1).cloned()),
            ")" if matches!(tokens.get(at + 1).map(String::as_str), Some("=>" | "{")) => {
                let open = tokens[..at].iter().rposition(|token| token == "(").unwrap_or(at);
                let before = open.checked_sub(1).map(|before| tokens[before].as_str());
                let is_call = matches!(before, Some("if" | "for" | "while" | "switch"));
                if !is_call {
                    own.extend(tokens[open + 1..at].iter().filter(|token| *token != ",").cloned());
                }
            }
            _ => {}
        }
    }
    own
}

/// Words and signs of a script, without comments; a text or number is one that means nothing here.
fn tokens(source: &str) -> Vec<String> {
    let (mut found, mut rest): (Vec<String>, &str) = (Vec::new(), source);
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '$';
        let after_value = found.last().is_some_and(|last| last == ")" || last == "]" || last.chars().all(is_word));
        let length = if let Some(comment) = rest.strip_prefix("//") {
            2 + comment.find('\n').unwrap_or(comment.len())
        } else if let Some(comment) = rest.strip_prefix("/*") {
            4 + comment.find("*/").unwrap_or(comment.len())
        } else if first == '"' || first == '\'' || (first == '/' && !after_value) {
            1 + ending(&rest[1..], first)
        } else if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else {
            ["...", "=>", "?.", "??", "**"]
                .iter()
                .find(|sign| rest.starts_with(**sign))
                .map_or(first.len_utf8(), |sign| sign.len())
        };
        let token = &rest[..length.min(rest.len())];
        let is_comment = token.starts_with("//") || token.starts_with("/*");
        match first {
            _ if is_comment || first.is_whitespace() => {}
            '"' | '\'' | '/' if token.len() > 1 => found.push("0".to_owned()),
            '0'..='9' => found.push(if token.contains('_') { "_" } else { "0" }.to_owned()),
            _ => found.push(token.to_owned()),
        }
        rest = &rest[token.len()..];
    }
    found
}

/// Returns the length of a text with the sign that ends it.
fn ending(text: &str, sign: char) -> usize {
    let mut is_escaped = false;
    for (at, letter) in text.char_indices() {
        if letter == sign && !is_escaped {
            return at + 1;
        }
        is_escaped = letter == '\\' && !is_escaped;
    }
    text.len()
}
