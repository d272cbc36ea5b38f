//! Sentences by chance, as people might say them, and strange ones.

use crate::dice::Dice;
use sentences::Language;

/// The events that may happen, in English and Japanese.
const EVENTS: [&[&str]; 2] = [
    &[
        "the head is touched",
        "somebody pats the back of the head",
        "I press the button",
        "you see a face",
        "a new face appears",
        "you recognise the child",
        "the red ball is there",
        "you see something green",
        "the blue ball shows up",
        "the child says \"yes\"",
        "the child says “hi” or “hello”",
        "somebody claps",
        "there is a loud noise",
        "it is quiet for 10 seconds",
        "nobody is there for half a minute",
        "the ball is not seen for 5 seconds",
        "the left hand is held for 2 seconds",
        "the right hand is let go",
        "the left foot bumps into something",
        "you fall over",
        "the battery is below 20 %",
        "someone is closer than 1.5 m",
        "the red ball is between 30 and 60 cm away",
        "something is nearer than half a metre in front of you",
        "more than two people are there",
        "you are sitting",
        "you see mark 64",
        "the head or a hand is touched",
        "the head is touched three times",
        "another person comes",
        "the child leaves",
        "the ball disappears",
        "the child says red, blue or green",
        "somebody stays closer than 70 cm for 3 seconds",
        "the program starts",
        "you see the red ball and the button is pressed",
        "it is nine o'clock",
        "you see a face in the morning",
    ],
    &[
        "頭を触ったら",
        "頭の後ろを触られたら",
        "ボタンを押したら",
        "顔が見えたら",
        "知らない人が来たら",
        "知っている顔が見えたら",
        "赤いボールを見つけたら",
        "緑のものが見えたら",
        "青いボールが見えたら",
        "子どもが「はい」と言ったら",
        "「うん」か「はい」と言われたら",
        "手をたたいたら",
        "大きな音がしたら",
        "10秒間静かだったら",
        "30秒間誰もいなかったら",
        "5秒間ボールが見えなかったら",
        "左手を2秒間触り続けたら",
        "右手から手が離れたら",
        "左足が何かにぶつかったら",
        "転んだら",
        "電池が20%を切ったら",
        "人が1.5メートルより近いとき",
        "赤いボールが30cmから60cmの間にあるとき",
        "目の前50センチ以内に何かあったら",
        "3人以上いたら",
        "ロボットが座ったら",
        "64番のマークが見えたら",
        "頭か手を触られたら",
        "頭を3回触ったら",
        "別の人が来たら",
        "人がいなくなったら",
        "赤いボールが見えなくなったら",
        "「あか」「あお」「みどり」のどれかを聞いたら",
        "人が3秒間見えていたら",
        "プログラムが始まったら",
        "ボールが見えてボタンが押されたら",
        "朝9時になったら",
        "朝、頭を触ったら",
    ],
];

/// The actions that may be done, in English and Japanese.
const ACTS: [&[&str]; 2] = [
    &[
        "say \"well done\"",
        "wave",
        "nod",
        "bow",
        "cheer",
        "sit down",
        "stand up",
        "turn the eyes green",
        "turn the eyes off",
        "beep",
        "play a high beep",
        "open the right hand",
        "raise both arms",
        "look at the red ball",
        "walk forward",
        "set the brightness of the eyes to 30 %",
        "say how many people there are",
        "turn the head 20 degrees to the left",
        "say \"one\", and 2 seconds later nod",
        "wave and say \"hello\"",
        "clap your hands",
        "give a high five",
        "wave with your left hand",
        "say \"a\", \"b\" or \"c\" at random",
        "say \"three\", then \"two\" and then \"one\", one second apart",
        "the robot dances",
    ],
    &[
        "「よくできました」と言う",
        "手を振る",
        "うなずく",
        "おじぎをする",
        "喜ぶ",
        "座る",
        "立つ",
        "目を緑にする",
        "目を消す",
        "音を鳴らす",
        "高い音を鳴らす",
        "右手を開く",
        "両腕を上げる",
        "赤いボールを見る",
        "前に歩く",
        "目の明るさを30%にする",
        "人の数を言う",
        "頭を左に20度向ける",
        "「いち」と言って、2秒後にうなずく",
        "手を振って「やあ」と言う",
        "拍手をする",
        "ハイタッチをする",
        "左手を振る",
        "「いち」か「に」か「さん」をランダムに言う",
        "目を青にしてから手を振る",
    ],
];

/// The parts that may be held meanwhile, in English and Japanese.
const HELD: [[&str; 4]; 2] =
    [["head", "left hand", "right hand", "back of the head"], ["頭", "左手", "右手", "後頭部"]];

/// A sentence of random clauses.
pub(crate) fn random(dice: &mut Dice, language: Language) -> String {
    let at = usize::from(language == Language::Japanese);
    let (event, act, other) = (dice.one(EVENTS[at]), dice.one(ACTS[at]), dice.one(ACTS[at]));
    if at == 0 {
        return match dice.below(17) {
            13 => format!("While the {} is held, {act} every 2 seconds.", dice.one(&HELD[0])),
            14 => format!("When {event}, {act} unless the {} is touched.", dice.one(&HELD[0])),
            15 => format!("When {event} while the {} is held, {act}.", dice.one(&HELD[0])),
            0 => format!("{act} when {event}"),
            1 => format!("When {event}, {act}, but at most once a minute."),
            2 => format!("When {event}, {act} once."),
            3 => format!("When {event}, {act} unless the battery is below 10 %."),
            4 => format!("Every 20 seconds if {event} {act}"),
            5 => format!("When {event}, {act}. Then {other}."),
            6 => format!("NAO, please {act} as soon as {event}!"),
            7 => format!("When {event}: {act}. If {}, {other}.", dice.one(EVENTS[0])),
            8 => format!("When {event}, {act}, but not again for 20 seconds."),
            9 => format!("Press the button to make the robot {act}."),
            10 => format!("Wave at everyone you know. When {event}, {other}."),
            11 => format!("Walk while the {} is touched. When {event}, {act}.", dice.one(&["head", "left hand"])),
            12 => format!(
                "When {event}, say \"ready\". If the child says \"yes\" within 10 seconds, {act}. If not, {other}."
            ),
            _ => format!("When {event}, {act}"),
        };
    }
    match dice.below(12) {
        10 => format!("{}を触っている間、2秒ごとに{act}。", dice.one(&HELD[1])),
        11 => format!("{}を触っていないかぎり、{event}{act}。", dice.one(&HELD[1])),
        6 => format!("{event}{act}。そのあと20秒間は言わない。"),
        7 => format!("知らない人には手を振る。{event}{act}。"),
        8 => format!("頭を触っている間は歩く。{event}{act}。"),
        9 => format!("電池が20%以下でないかぎり、{event}{act}。"),
        0 => format!("{event}{act}。ただし1分に1回まで。"),
        1 => format!("{event}、一度だけ{act}"),
        2 => format!("20秒ごとに、{event}{act}"),
        3 => format!("{event}{act}。それから{other}。"),
        4 => format!("{event}{act}。{}{other}。", dice.one(EVENTS[1])),
        _ => format!("もし{event}、{act}。"),
    }
}

/// The pieces that no sentence has, or has elsewhere.
const PIECES: [&str; 36] = [
    "(",
    ")",
    "`",
    "“",
    "”",
    "「",
    "」",
    ",",
    ".",
    "-",
    "9",
    "1e9",
    "99999999999999999999",
    "\u{0}",
    "é",
    "とき",
    "、",
    " when ",
    " or ",
    " and ",
    " every ",
    "が",
    "😀",
    "\n",
    "|",
    "ー",
    "００",
    "'",
    "n't",
    " 1,000 ",
    "半",
    "十百",
    " a half ",
    " until ",
    "まで",
    "ないで",
];

/// Makes a few slips in a text: letters that are missing, an end that is cut off, pieces that do not belong there.
pub(crate) fn slip(dice: &mut Dice, chars: &mut Vec<char>) {
    for _ in 0..=dice.below(6) {
        let at = dice.below(chars.len() + 1);
        match dice.below(3) {
            0 if at < chars.len() => drop(chars.remove(at)),
            1 => chars.truncate(at.max(3)),
            _ => drop(chars.splice(at..at, dice.one(&PIECES).chars())),
        }
    }
}

/// Signs and letters by chance, or a sentence with a few slips.
pub(crate) fn strange(dice: &mut Dice, language: Language, is_random: bool) -> String {
    let mut chars: Vec<char> = if is_random {
        (0..dice.below(40)).flat_map(|_| dice.one(&PIECES).chars()).collect()
    } else {
        random(dice, language).chars().collect()
    };
    slip(dice, &mut chars);
    chars.into_iter().collect()
}
