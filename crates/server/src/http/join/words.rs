//! What the pages of invitations say, in English and in Japanese: they come before the page, which knows its language.

use crate::invitations::NotIn;
use axum::http::{HeaderMap, header};
use protocol::Role;

/// In which language a browser is answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::http) enum BrowserLanguage {
    English,
    Japanese,
}

impl BrowserLanguage {
    /// What the browser asks for first.
    pub(in crate::http) fn of(headers: &HeaderMap) -> Self {
        let asked = headers.get(header::ACCEPT_LANGUAGE).and_then(|asked| asked.to_str().ok()).unwrap_or_default();
        let first = asked.split([',', ';']).next().unwrap_or_default().trim().to_ascii_lowercase();
        if first == "ja" || first.starts_with("ja-") { Self::Japanese } else { Self::English }
    }

    /// The tag of this language, as HTML has it.
    pub(in crate::http) fn code(self) -> &'static str {
        self.said("en", "ja")
    }

    /// One of two texts.
    pub(in crate::http) fn said(self, english: &'static str, japanese: &'static str) -> &'static str {
        match self {
            Self::English => english,
            Self::Japanese => japanese,
        }
    }

    pub(super) fn invited(self) -> [&'static str; 2] {
        [
            self.said("You are invited", "招待されています"),
            self.said("Somebody who has a robot invites you.", "ロボットを使っている人から招待されています。"),
        ]
    }

    /// Who invites, and what for.
    pub(super) fn invites(self, by: &str, role: Role) -> String {
        // A terminal makes invitations in the name of its program.
        let is_named = !by.is_empty() && !by.starts_with("rrp ");
        let by = if is_named {
            by
        } else {
            self.said("The person at the robot’s computer", "ロボットのコンピューターを使っている人")
        };
        match self {
            Self::English => {
                let may = match role {
                    Role::Viewer => {
                        "to watch what a robot does. You see the programs and can press Stop; you change nothing."
                    }
                    Role::Operator => "to run a robot. You start and stop programs; you do not edit them.",
                    Role::Editor | Role::Host => {
                        "to build robot programs together. You edit them, and start and stop the robot."
                    }
                };
                format!("{by} invites you {may}")
            }
            Self::Japanese => {
                let may = match role {
                    Role::Viewer => {
                        "ロボットの動きを見ることができます。プログラムの表示と停止はできますが、変更はできません。"
                    }
                    Role::Operator => "ロボットを動かせます。プログラムの開始と停止はできますが、編集はできません。",
                    Role::Editor | Role::Host => {
                        "ロボットのプログラムをいっしょに作れます。編集と、ロボットの開始と停止ができます。"
                    }
                };
                let by = if matches!(by, "ロボットのコンピューターを使っている人") {
                    by.to_owned()
                } else {
                    format!("{by} さん")
                };
                format!("{by}からの招待です。{may}")
            }
        }
    }

    pub(super) fn by_invitation(self) -> [&'static str; 2] {
        [
            self.said("By invitation only", "招待された人だけが入れます"),
            self.said(
                "Ask the person at the robot’s computer for an invitation: a link to open here, or its QR code to scan.",
                "ロボットのコンピューターを使っている人に、招待を頼んでください。リンクをここで開くか、QR コードを読み取ります。",
            ),
        ]
    }

    /// For who follows the link of the host.
    pub(super) fn opening(self) -> [&'static str; 2] {
        [
            self.said("Opening rrp", "rrp を開いています"),
            self.said(
                "This browser becomes the host’s: it stays in, also after a restart.",
                "このブラウザーがホストになります。再起動の後もそのまま使えます。",
            ),
        ]
    }

    /// For who is at the host's computer and not known.
    pub(super) fn by_link(self) -> [&'static str; 2] {
        [
            self.said("This browser is not known here yet", "このブラウザーはまだ登録されていません"),
            self.said(
                "In a terminal of this computer, run “rrp open” and open the link that it prints. Stop works without it.",
                "このコンピューターの端末で「rrp open」を実行し、表示されたリンクを開いてください。停止は今すぐ使えます。",
            ),
        ]
    }

    /// For who comes through a tunnel with this port and is not known.
    pub(super) fn by_link_through(self, port: u16) -> String {
        match self {
            Self::English => format!(
                "In a terminal of the computer that runs rrp, run “rrp open”. Open the link that it prints here, with {port} \
                 in the place of its port. Stop works without it."
            ),
            Self::Japanese => format!(
                "rrp を動かしているコンピューターの端末で「rrp open」を実行し、表示されたリンクのポート番号を {port} に変えて、ここで開いてください。停止は今すぐ使えます。"
            ),
        }
    }

    /// For who opens the link of the host a second time.
    pub(super) fn old_link(self) -> [&'static str; 2] {
        [
            self.said("This link was used already", "このリンクは使用済みです"),
            self.said(
                "Each link works once, until rrp ends. Run “rrp open” in a terminal of this computer and open the link \
                 that it prints. Stop works without it.",
                "リンクは rrp が終わるまでに一度だけ使えます。このコンピューターの端末で「rrp open」を実行し、表示されたリンクを開いてください。停止は今すぐ使えます。",
            ),
        ]
    }

    /// What is on the button that stops all robots.
    pub(super) fn stop_all(self) -> &'static str {
        self.said("Stop all robots", "すべてのロボットを停止")
    }

    pub(super) fn not_in(self) -> &'static str {
        self.said("You are not in yet", "まだ入っていません")
    }

    /// Why somebody did not come in.
    pub(super) fn why(self, why: &NotIn) -> String {
        match (self, why) {
            (Self::English, why) => why.to_string(),
            (Self::Japanese, NotIn::Unknown) => {
                "このリンクは使えないか、使えなくなりました。もう一度招待を頼んでください。".to_owned()
            }
            (Self::Japanese, NotIn::TooMany(seconds)) => format!(
                "このリンクは使えません。使えないリンクが、あなたのネットワークから何度も試されました。もう一度招待を頼むか、{seconds} 秒待ってから別のリンクを開いてください。"
            ),
            (Self::Japanese, NotIn::NotKept(reason)) => format!(
                "今は入れませんでした（{reason}）。しばらくしてからもう一度リンクを開くか、ロボットのコンピューターを使っている人に伝えてください。"
            ),
        }
    }

    pub(super) fn join(self) -> &'static str {
        self.said("Come in", "入る")
    }

    pub(super) fn broken(self) -> &'static str {
        self.said(
            "This link is not whole. Copy all of it, or scan the QR code again.",
            "リンクが途中で切れています。全部をコピーするか、QR コードをもう一度読み取ってください。",
        )
    }

    pub(super) fn needs_script(self) -> &'static str {
        self.said(
            "This page needs JavaScript. Allow it for this address, then open the link again.",
            "このページには JavaScript が必要です。このアドレスで許可してから、リンクをもう一度開いてください。",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::BrowserLanguage;
    use crate::invitations::NotIn;
    use axum::http::{HeaderMap, HeaderValue, header};

    fn asked(text: &'static str) -> BrowserLanguage {
        BrowserLanguage::of(&HeaderMap::from_iter([(header::ACCEPT_LANGUAGE, HeaderValue::from_static(text))]))
    }

    #[test]
    fn the_browser_says_in_which_language() {
        for text in ["ja", "ja-JP,ja;q=0.9,en;q=0.8", "JA-jp"] {
            assert_eq!(asked(text), BrowserLanguage::Japanese, "{text}");
        }
        for text in ["", "en-GB,ja;q=0.5", "jam", "*"] {
            assert_eq!(asked(text), BrowserLanguage::English, "{text}");
        }
        assert_eq!(BrowserLanguage::of(&HeaderMap::new()), BrowserLanguage::English);
    }

    #[test]
    fn every_reason_is_said_in_japanese() {
        for why in [NotIn::Unknown, NotIn::TooMany(9), NotIn::NotKept("…".into())] {
            assert!(
                BrowserLanguage::Japanese.why(&why).contains('。') && BrowserLanguage::English.why(&why).contains('.')
            );
        }
    }
}
