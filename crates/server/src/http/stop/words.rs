//! Words of the page after a Stop, in English and in Japanese: it comes where rrp's own page cannot say it.

use crate::http::join::BrowserLanguage;
use crate::http::origin::NotAllowed;

impl BrowserLanguage {
    pub(super) fn stopped(self) -> [&'static str; 2] {
        [
            self.said("Stopped", "停止しました"),
            self.said(
                "The robot holds still. If it goes on, press Stop again, or press the button on its chest.",
                "ロボットは静止しています。まだ動くときは、もう一度「停止」を押すか、ロボットの胸のボタンを押してください。",
            ),
        ]
    }

    /// Why a Stop was not taken, and what to do.
    pub(super) fn not_stopped(self, why: NotAllowed) -> [&'static str; 2] {
        let text = match why {
            NotAllowed::NotInvited => self.said(
                "You are not in, or not any more. Press the button on its chest, and ask the person at the robot’s \
                 computer for an invitation.",
                "あなたはまだ入っていないか、もう入れません。ロボットの胸のボタンを押し、ロボットのコンピューターを使っている人に招待を頼んでください。",
            ),
            NotAllowed::OtherHost => self.said(
                "This computer is reached by another address here. Press the button on its chest, or open the address that \
                 rrp printed, and press Stop there.",
                "このコンピューターには別のアドレスで接続します。ロボットの胸のボタンを押すか、rrp が表示したアドレスを開いて、そこで「停止」を押してください。",
            ),
            NotAllowed::Forwarded => self.said(
                "A proxy passes this on to a server that was not told of it. Press the button on its chest. Whoever runs \
                 rrp starts it with --behind-proxy.",
                "プロキシがこの操作を、プロキシを使う設定になっていないサーバーに渡しました。ロボットの胸のボタンを押してください。rrp は --behind-proxy を付けて起動します。",
            ),
            NotAllowed::OtherPage | NotAllowed::NoOrigin | NotAllowed::NoHost | NotAllowed::Unreadable => self.said(
                "Your browser did not say that this press came from rrp’s own page. Press Stop here again, or press the \
                 button on its chest.",
                "ブラウザーは、rrp のページで押されたことを伝えませんでした。ここでもう一度「停止」を押すか、ロボットの胸のボタンを押してください。",
            ),
        };
        [self.said("Stop did not reach the robot", "停止はロボットに届きませんでした"), text]
    }

    pub(super) fn stop(self) -> &'static str {
        self.said("Stop", "停止")
    }

    pub(super) fn back(self) -> &'static str {
        self.said("Back to rrp", "rrp に戻る")
    }
}
