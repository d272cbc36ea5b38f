//! Builds one typed sentence as `rrp build --json` does, without the rest of the program: `said --language en --json TEXT`.
use behaviour::{BehaviourFile, Helper};
use sentences::{Language, Lexicon, read_speech};
use serde_json::json;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "build" && arg != "--json").collect();
    let language: Language = args[1].parse().unwrap();
    let text = &args[2];
    let lexicon = Lexicon::read(load(language.code()), language);
    let helpers = robot::shipped_helpers();
    let helpers: Vec<&Helper> = helpers.iter().collect();
    if text == "-" {
        for line in std::io::stdin().lines() {
            let line = line.unwrap();
            if line.trim().is_empty() { continue; }
            let started = std::time::Instant::now();
            if std::env::var("SPEED").is_ok() {
                let _ = sentences::read(&line, language, &helpers, None);
                let one = started.elapsed();
                let _ = read_speech(&line, language, &lexicon, &helpers, None);
                println!("{} {} {line}", one.as_micros(), started.elapsed().as_micros() - one.as_micros());
                continue;
            }
            let reading = read_speech(&line, language, &lexicon, &helpers, None);
            if reading.is_whole() {
                let told = sentences::explain(&reading.draft.behaviour(), &helpers, &|_| None, language);
                let told: Vec<String> = told.iter().map(ToString::to_string).collect();
                println!("{line}\n      = {}", told.join(" "));
            } else {
                let doubts: Vec<String> = reading.doubts.iter().map(|doubt| format!("[{}] {:?} {}", &line[doubt.range.clone()], doubt.suggestions, doubt.why.clone().unwrap_or_default())).collect();
                println!("{line}\n      ? {}", doubts.join("; "));
            }
        }
        return;
    }
    let reading = read_speech(text, language, &lexicon, &helpers, None);
    if reading.doubts.is_empty() && !reading.draft.connectors.is_empty() {
        let file = BehaviourFile::of(&reading.draft.behaviour(), &helpers);
        println!("{}", json!({"behaviour": file}));
        return;
    }
    let doubts: Vec<_> = reading.doubts.iter().map(|doubt| json!({"text": &text[doubt.range.clone()], "suggestions": doubt.suggestions})).collect();
    println!("{}", json!({"doubts": doubts}));
    std::process::exit(3);
}

fn load(code: &str) -> &'static str {
    let folder = std::env::var("LEXICON").unwrap_or_else(|_| "/work/w-f/static".to_owned());
    std::fs::read_to_string(format!("{folder}/speech-{code}.txt")).unwrap().leak()
}
