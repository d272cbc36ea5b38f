//! The words of answers: why a value came, and why another one did not. They stand apart from the others, as a page that tells no
//! answers need not load them.

use crate::Language;

/// The words for a meaning, with holes.
pub(crate) type Answer = (&'static str, &'static str);

/// The words of a language.
pub(crate) fn answers(language: Language) -> &'static [Answer] {
    match language {
        Language::English => ENGLISH,
        Language::Japanese => JAPANESE,
    }
}

const ENGLISH: &[Answer] = &[
    ("why.action", "At {time} {name} was told {value}."),
    ("why.came", "{name} came at {time}: {value}."),
    ("why.passed", "{name} came at {time}: {asked} {test}."),
    ("why.changed", "{name} came at {time}, as {value} is another value than before."),
    ("why.later", "{name} passed on at {time} what came at {since}: {value}."),
    ("why.sensed", "At {time}: {clause} ({value})."),
    ("why.does", "At {time}: {clause}."),
    ("why.it", "it"),
    ("why.reading", "{name} was sensed at {time}: {value}."),
    ("why.lost", "{name} came at {time}: {value}. What it came of is not known."),
    ("why.with", " With it {name} was {value}, {ago}."),
    ("why.memory", " Before, it was {value}."),
    ("why.yes", "yes"),
    ("why.no", "no"),
    ("why.now", "come at that moment"),
    ("why.ago", "come {d} earlier"),
    ("why.ms", "{n} ms"),
    ("why.s", "{n} s"),
    ("whyNot.test", "At {time} {name} kept {asked} back: it keeps only what {test}."),
    ("whyNot.same", "At {time} {name} kept {value} back: it was the same as before."),
    ("whyNot.kept", "At {time} {name} kept {value} back."),
    ("whyNot.fault", "At {time} the procedure of {name} failed for {value}."),
    ("whyNot.holds", "{name} still holds {value}, which came at {time}."),
    (
        "whyNot.waits",
        "{name} waits: {from} came at {time} with {value}, and something else that it needs did not come yet.",
    ),
    ("whyNot.nothing", "Nothing came from {from}."),
    ("whyNot.none", "Nothing is known that kept {name} back."),
];

const JAPANESE: &[Answer] = &[
    ("why.action", "{time}に{name}へ{value}が伝えられました。"),
    ("why.came", "{time}に{name}が来ました：{value}。"),
    ("why.passed", "{time}に{name}が来ました。{asked}が{test}からです。"),
    ("why.changed", "{time}に{name}が来ました。{value}が前と違う値だからです。"),
    ("why.later", "{name}は{since}に来た{value}を{time}に渡しました。"),
    ("why.sensed", "{time}：{clause}（{value}）。"),
    ("why.does", "{time}：{clause}。"),
    ("why.it", "それ"),
    ("why.reading", "{time}に{name}を感じました：{value}。"),
    ("why.lost", "{time}に{name}が来ました：{value}。何から来たかは分かりません。"),
    ("why.with", "そのとき{name}は{value}で、{ago}。"),
    ("why.memory", "その前は{value}でした。"),
    ("why.yes", "はい"),
    ("why.no", "いいえ"),
    ("why.now", "同じ時に来ました"),
    ("why.ago", "{d}前に来ました"),
    ("why.ms", "{n}ミリ秒"),
    ("why.s", "{n}秒"),
    ("whyNot.test", "{time}に{name}は{asked}を止めました。{test}ものだけを通すからです。"),
    ("whyNot.same", "{time}に{name}は{value}を止めました。前と同じ値だからです。"),
    ("whyNot.kept", "{time}に{name}は{value}を止めました。"),
    ("whyNot.fault", "{time}に{name}の手続きが{value}で失敗しました。"),
    ("whyNot.holds", "{name}は{time}に来た{value}をまだ持っています。"),
    ("whyNot.waits", "{name}は待っています。{from}は{time}に{value}で来ましたが、ほかに必要なものがまだ来ていません。"),
    ("whyNot.nothing", "{from}から何も来ませんでした。"),
    ("whyNot.none", "{name}を止めたものは分かりません。"),
];
