//! The words of a report, in English and in Japanese.

use crate::clock::length;
use crate::replayed::Replayed;
use protocol::MarkSort;
use sentences::Language;

/// The words of one language.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Words(pub(crate) Language);

/// Texts without holes, after a name for all of them: a name, English, Japanese.
macro_rules! said {
    ($all:ident; $($name:ident: $english:literal, $japanese:literal;)*) => {
        impl Words {
            $(pub(crate) fn $name(self) -> &'static str {
                self.said($english, $japanese)
            })*

            /// All of them, in both languages.
            #[cfg(test)]
            pub(crate) fn $all() -> Vec<[&'static str; 2]> {
                vec![$([$english, $japanese]),*]
            }
        }
    };
}

pub(crate) use said;

said! {
    all_of_reports;
    after: "After", "変更後";
    as_if: "As if: ", "ためしに：";
    before: "Before", "変更前";
    beside: "Beside the report", "レポートの操作";
    by: "By", "操作した人";
    by_hand: "By hand", "手動操作";
    by_operators: "written by the operators", "操作した人が書いたもの";
    by_program: "By the program", "プログラムの動作";
    colon: ": ", "：";
    comma: ", ", "、";
    count: "Count", "回数";
    day: "Day", "日付";
    does_nothing: "The program has no action.", "このプログラムには動作がありません。";
    download: "Download", "ダウンロード";
    ended: "It ended", "終わりの理由";
    fell: "The robot fell.", "ロボットが転びました。";
    halted: "The robot interrupted the program.", "ロボットがプログラムを中断しました。";
    is_cut_off: "The recording ends here without its last line: the server or the disk ended first.",
        "記録はここで途切れています。サーバーかディスクが先に終わりました。";
    is_full: "The recording is as large as one may be, and ends here.", "記録が最大の大きさになり、ここで終わっています。";
    kept_by: "It was kept by", "優先：";
    length: "Length", "長さ";
    marks: "Marks", "印";
    marks_only: "Only marks and actions were recorded: what the robot sensed is not here, and nothing can be replayed.",
        "印と動作だけの記録です。センサーの値はなく、再生して確かめることはできません。";
    no_marks: "Nothing was marked.", "印はありません。";
    no_name: "The participant stands here as a code. No name was asked for.",
        "参加者はコードで示しています。名前はたずねていません。";
    no_program: "The recording is cut off before it says what ran.", "何が実行されたかが書かれる前に、記録が途切れています。";
    no_troubles: "None.", "ありません。";
    nobody: "nobody is named in it", "名前の記録なし";
    not_by_hand: "was pressed and not done", "を押しましたが、実行されませんでした";
    note_only: "a note only", "メモだけ";
    notes: "Notes and verdicts", "メモと評価";
    nothing_by_hand: "Nothing was done by hand.", "手動操作はありません。";
    old_form: "This recording is of an older form. It lacks the program, and what was pretended, refused or done by hand; streams \
               stand here by their ids.",
        "古い形式の記録です。プログラムと、ためしに入れた値、断られた動作、手動操作は残っていません。ストリームは ID で示しています。";
    other_language: "日本語", "English";
    own_words: "Notes are the operators’ own words. Read them before you hand this report on.",
        "メモは操作した人が自由に書いたものです。レポートを渡す前に読んでください。";
    people: "People", "操作した人";
    print: "Print it", "印刷";
    replay: "Replay", "再生";
    robot: "Robot", "ロボット";
    same_sentences: "Its sentences are the same.", "文は同じです。";
    sensed: "What it sensed", "感じたもの";
    session: "session", "セッション";
    this_one: " · this one", "・この回";
    time: "Time", "時間";
    timeline: "Timeline", "時間の流れ";
    timeline_label: "Timeline of the session. The tables below say the same in numbers.",
        "セッションの時間の流れ。下の表に同じことを数で示しています。";
    troubles: "Troubles", "問題";
    unknown: "not known", "不明";
    unreadable_program: "This rrp cannot read the program in it. Update rrp, then open the report again.",
        "この rrp では記録の中のプログラムを読めません。rrp を更新してから、もう一度開いてください。";
    values: "Values by id", "ID ごとの値";
    version_row: "Version", "版";
    what: "What", "内容";
    what_it_did: "What it did", "プログラム";
    word: "Word", "言葉";
}

impl Words {
    pub(crate) fn said(self, english: &'static str, japanese: &'static str) -> &'static str {
        match self.0 {
            Language::English => english,
            Language::Japanese => japanese,
        }
    }

    /// One of two texts with holes.
    pub(crate) fn either(self, english: String, japanese: String) -> String {
        match self.0 {
            Language::English => english,
            Language::Japanese => japanese,
        }
    }

    /// The title, of the session of a participant with this code.
    pub(crate) fn title(self, code: Option<&str>) -> String {
        match code {
            Some(code) => self.either(format!("Session report: {code}"), format!("セッションのレポート：{code}")),
            None => self.said("Session report", "セッションのレポート").to_owned(),
        }
    }

    pub(crate) fn version(self, revision: u64) -> String {
        self.either(format!("version {revision}"), format!("版 {revision}"))
    }

    pub(crate) fn time_span(self, from: &str, to: &str, length: &str) -> String {
        self.either(format!("{from} to {to} ({length})"), format!("{from}〜{to}（{length}）"))
    }

    pub(crate) fn battery(self, first: u8, last: u8) -> String {
        if first == last {
            self.either(format!("battery {first} %"), format!("バッテリー {first} %"))
        } else {
            self.either(format!("battery {first} to {last} %"), format!("バッテリー {first}〜{last} %"))
        }
    }

    pub(crate) fn changed(self, at: &str, revision: u64) -> String {
        self.either(
            format!("At {at} changed while it ran: version {revision}."),
            format!("{at} に実行中に変更：版 {revision}。"),
        )
    }

    pub(crate) fn more(self, count: u64) -> String {
        self.either(format!("and {count} more"), format!("ほか {count} 件"))
    }

    pub(crate) fn cut_off(self, until: &str) -> String {
        self.either(
            format!("It ends early, at {until}: the server or the disk ended before its last line was written."),
            format!("{until} で途切れています。最後の行が書かれる前に、サーバーかディスクが終わりました。"),
        )
    }

    pub(crate) fn full(self, until: &str) -> String {
        self.either(
            format!("It ends early, at {until}: it is as large as a recording may be."),
            format!("{until} で終わっています。記録が最大の大きさになりました。"),
        )
    }

    pub(crate) fn goes_on(self, until: &str) -> String {
        self.either(
            format!("The session goes on. This is what was recorded until {until}; reload the page to see more."),
            format!(
                "セッションは続いています。{until} までの記録です。続きを見るには、ページを読み込み直してください。"
            ),
        )
    }

    pub(crate) fn unread(self, until: &str) -> String {
        self.either(
            format!("The recording is too long to be read at once. This report says what came until {until}; what came after \
                     is in the download."),
            format!("記録が長すぎて、一度に読めません。{until} までのレポートです。そのあとは、ダウンロードした記録にあります。"),
        )
    }

    /// `3 times`, for what happened more than once.
    pub(crate) fn times(self, count: u64) -> String {
        match count {
            1 => String::new(),
            _ => self.either(format!(", {count} times"), format!("（{count} 回）")),
        }
    }

    pub(crate) fn not_done(self, count: u64) -> String {
        self.either(format!("was refused{}", self.times(count)), format!("は実行されませんでした{}", self.times(count)))
    }

    pub(crate) fn failed(self, count: u64) -> String {
        self.either(format!("failed{}", self.times(count)), format!("の計算が失敗しました{}", self.times(count)))
    }

    /// A length in a sentence: `8 s`, `1:20`.
    pub(crate) fn lasting(self, ms: u64) -> String {
        match ms {
            0..60_000 => self.either(format!("{} s", ms.div_ceil(1_000)), format!("{} 秒", ms.div_ceil(1_000))),
            _ => length(ms),
        }
    }

    pub(crate) fn no_connection(self, lasted: Option<String>) -> String {
        match lasted {
            Some(lasted) => self.either(
                format!("No connection to the robot for {lasted}."),
                format!("{lasted} の間、ロボットとの接続がありませんでした。"),
            ),
            None => self
                .said("No connection to the robot until the end.", "最後までロボットとの接続がありませんでした。")
                .to_owned(),
        }
    }

    pub(crate) fn weak(self, lasted: Option<String>) -> String {
        match lasted {
            Some(lasted) => self.either(
                format!("The robot was not wholly ready for {lasted}."),
                format!("{lasted} の間、ロボットの一部が使えませんでした。"),
            ),
            None => self
                .said("The robot was not wholly ready until the end.", "最後までロボットの一部が使えませんでした。")
                .to_owned(),
        }
    }

    pub(crate) fn late(self, count: u64) -> String {
        self.either(
            format!("Values that were dropped in all, as a procedure took too long: {count}."),
            format!("処理に時間がかかりすぎて捨てられた値：合計 {count} 個。"),
        )
    }

    pub(crate) fn missing(self, lost: u64) -> String {
        self.either(
            format!("Lines that could not be written in time and are missing here: {lost}."),
            format!("書き込みが間に合わず、ここに欠けている行：{lost} 行。"),
        )
    }

    pub(crate) fn over_sessions(self, code: &str, count: usize) -> String {
        self.either(format!("{code} over {count} sessions"), format!("{code} の {count} 回のセッション"))
    }

    /// The unit of a plot.
    pub(crate) fn unit(self, lasts: bool) -> &'static str {
        if lasts { self.said("minutes:seconds", "分:秒") } else { self.said("times", "回") }
    }

    pub(crate) fn switch_names(self, names: bool) -> &'static str {
        if names {
            self.said("Show codes instead of names", "名前の代わりにコードを表示")
        } else {
            self.said("Show the names of staff", "スタッフの名前を表示")
        }
    }

    pub(crate) fn about_names(self, names: bool) -> &'static str {
        if names {
            self.said(
                "Staff are named here and in the downloads. Faces and recognised words are left out of the tables for other programs; the .jsonl \
                 has everything.",
                "スタッフの名前は、ここでもダウンロードでも表示されます。ほかのプログラム用の表には、顔と聞き取った言葉は含まれません。.jsonl にはすべてが入っています。",
            )
        } else {
            self.said(
                "Staff stand here and in the downloads as P1, P2 and so on; only the .jsonl has everything as it was recorded.",
                "スタッフは、ここでもダウンロードでも P1、P2 などと示されます。.jsonl だけには、すべてが記録されたまま入っています。",
            )
        }
    }

    /// The verdict of a mark on its moment.
    pub(crate) fn verdict(self, sort: MarkSort) -> &'static str {
        match sort {
            MarkSort::Note => "",
            MarkSort::Good => self.said("good", "良い"),
            MarkSort::Bad => self.said("not good", "良くない"),
            MarkSort::Now => self.said("it should have", "してほしかった"),
        }
    }

    /// The finding of a replay; `at` tells moments.
    pub(crate) fn replayed(self, found: Replayed, at: impl Fn(u64) -> String) -> String {
        let plain = match found {
            Replayed::Same => self.said("same as recorded", "記録どおり"),
            Replayed::OldForm => {
                self.said("not possible: old file without the program", "できません：古い記録でプログラムがありません")
            }
            Replayed::MarksOnly => {
                self.said("not possible: marks and actions only", "できません：印と動作だけの記録です")
            }
            Replayed::Unknown => self.said(
                "not possible: it lacks what ran or what that remembered",
                "できません：実行内容の記録が足りません",
            ),
            Replayed::CannotRun => self.said(
                "not possible: the program in it cannot run here",
                "できません：記録の中のプログラムをここでは実行できません",
            ),
            Replayed::TooLong => self.said(
                "not tried, as it is long; use rrp replay --check with the download",
                "長いため試していません。ダウンロードして rrp replay --check を使ってください",
            ),
            Replayed::Differs(ms) => {
                return self.either(format!("differs from {}", at(ms)), format!("{} から違う", at(ms)));
            }
            Replayed::SameUntil(ms) => {
                let until = at(ms);
                return self.either(
                    format!("same as recorded until {until}; lines are missing after it"),
                    format!("{until} までは記録どおり。そのあとは行が欠けています"),
                );
            }
        };
        plain.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::Words;

    #[test]
    fn every_text_has_its_japanese() {
        for [english, japanese] in [Words::all_of_reports(), Words::all_of_lists()].concat() {
            assert!(!japanese.is_empty() && english != japanese, "{english}");
            let has_kana = !japanese.is_ascii();
            assert!(has_kana || english == "日本語", "{japanese}");
        }
    }
}
