//! The words of the list of recordings, in English and in Japanese.

use crate::page::words::{Words, said};
use sentences::Language;

said! {
    all_of_lists;
    all_codes: "All codes", "すべてのコード";
    all_programs: "All programs", "すべてのプログラム";
    around: "Around the list", "一覧の操作";
    back_to_list: "Back to the recordings", "記録一覧に戻る";
    bin: "Bin", "ごみ箱";
    bin_is_empty: "The bin is empty.", "ごみ箱は空です。";
    bring_back: "Bring it back", "復元する";
    cannot_come_back: "It cannot be brought back after that. Download it first if anybody may need it.",
        "削除すると元に戻せません。必要になるかもしれない場合は、先に復元してダウンロードしてください。";
    chosen: "The recording you look at", "選んだ記録";
    code: "Code", "コード";
    ends_early: "ends early", "途中まで";
    find: "Find", "探す";
    find_hint: "Code, program, person, name or day …", "コード、プログラム、人、名前、日付…";
    look_back: "Look back", "ふり返る";
    marks_and_actions_only: "marks only", "印だけ";
    name_hint: "A name for this recording", "この記録の名前";
    no_code: "no code", "コードなし";
    none_found: "No recording is found. Switch on Record before Start, or look for something else.",
        "記録が見つかりません。開始する前に記録をオンにするか、別の言葉で探してください。";
    not_done_title: "That was not done", "実行できませんでした";
    not_looked_at: "not checked yet", "まだ確かめていません";
    note: "Note", "メモ";
    old_file: "old file: no program", "古い記録：プログラムなし";
    operate: "Operator’s page", "操作の画面";
    program: "Program", "プログラム";
    programs: "Programs", "プログラム一覧";
    recording_now: "recording now", "記録中";
    recordings: "Recordings", "記録一覧";
    remove_for_good: "Remove it for good", "完全に削除する";
    remove_mark: "Remove", "削除";
    rename: "Rename", "名前を変更";
    report: "Report", "レポート";
    save: "Save", "保存";
    size: "Size", "大きさ";
    stop_all: "Stop all robots", "すべてのロボットを停止";
    to_the_bin: "To the bin", "ごみ箱へ";
}

impl Words {
    pub(super) fn show_more(self, count: usize) -> String {
        self.either(format!("Show more ({count})"), format!("もっと見る（{count}）"))
    }

    pub(super) fn so_many(self, count: usize, bytes: &str, most: &str) -> String {
        self.either(
            format!("{count} recordings · {bytes} of {most}"),
            format!("{count} 件の記録・{most} のうち {bytes}"),
        )
    }

    /// A refusal of the server, in the language of the page as far as it is known in it.
    #[must_use]
    pub(crate) fn refusal(self, why: &protocol::Refused) -> String {
        match (self.0, why) {
            (Language::English, why) => why.to_string(),
            (Language::Japanese, protocol::Refused::NoRecording) => {
                "その記録はもうありません。一覧をもう一度見てください。".to_owned()
            }
            (Language::Japanese, why) => format!("記録を変更できませんでした。理由（英語）：{why}"),
        }
    }
}
