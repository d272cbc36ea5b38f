//! The harness tested on a small page of its own: a journey may trust it.

use std::path::Path;
use std::time::Duration;

use house::{Browser, Outcome, Page, Rules, Server, skip};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};

const PAGE: &str = include_str!("harness/page.html");
const SCRIPT: &str = include_str!("harness/page.js");

/// A person on the little page; the browser is kept, as those in it end when it is dropped.
async fn someone() -> Outcome<(Browser, Page, String)> {
    let url = serve().await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    page.goto(&url).await?;
    Ok((browser, page, url))
}

/// Serves the little page on a free port for as long as the test runs.
async fn serve() -> Outcome<String> {
    let listener = TcpListener::bind("127.0.0.1:0").await?;
    let url = format!("http://{}/", listener.local_addr()?);
    tokio::spawn(async move {
        while let Ok((stream, _)) = listener.accept().await {
            tokio::spawn(answer(stream));
        }
    });
    Ok(url)
}

async fn answer(mut stream: TcpStream) -> std::io::Result<()> {
    let mut asked = [0; 4096];
    let length = stream.read(&mut asked).await?;
    let asked = String::from_utf8_lossy(&asked[..length]).into_owned();
    let path = asked.split(' ').nth(1).unwrap_or_default();
    let (status, kind, body) = match path {
        "/" | "/strict" => ("200 OK", "text/html", PAGE),
        "/page.js" => ("200 OK", "text/javascript", SCRIPT),
        _ => ("404 Not Found", "text/plain", "no"),
    };
    let policy = if path == "/strict" { "Content-Security-Policy: default-src 'self'\r\n" } else { "" };
    let head = format!("HTTP/1.1 {status}\r\nContent-Type: {kind}\r\n{policy}Content-Length: {}\r\n", body.len());
    stream.write_all(format!("{head}Connection: close\r\n\r\n{body}").as_bytes()).await
}

macro_rules! ready {
    ($part:literal) => {
        skip::unless!(ready_browser(concat!("the harness: ", $part)));
    };
}

#[tokio::test]
async fn pressing_finds_what_people_see() -> Outcome<()> {
    ready!("pressing");
    let (_browser, aiko, _) = someone().await?;
    aiko.press("button", "Run").await?;
    aiko.press_twice("button", "Run").await?;
    aiko.until("seen.clicks === 3", "three clicks were counted").await?;
    assert_eq!(aiko.text("status", "Said").await?, "run 3");
    aiko.press("button", "Far*").await?;
    assert_eq!(aiko.eval("seen.far").await?, true);
    assert_eq!(aiko.count("button", "Twin").await?, 2);
    assert_eq!(aiko.count("button", "Hidden").await?, 0);
    aiko.gone("button", "Hidden").await?;
    aiko.press("checkbox", "Agree").await?;
    assert_eq!(aiko.eval("document.getElementById('tick').checked").await?, true);
    aiko.no_errors()
}

#[tokio::test]
async fn a_part_of_the_page_is_meant_alone() -> Outcome<()> {
    ready!("parts");
    let (_browser, aiko, _) = someone().await?;
    aiko.within("group", "Second").press("button", "Twin").await?;
    assert_eq!(aiko.eval("document.activeElement.id").await?, "second");
    assert_eq!(aiko.within("group", "Second").find_all("button", "").await?.len(), 1);
    let here = "function () { return this.id; }";
    assert_eq!(aiko.until_on("button", "Run", here, "it has a name").await?, "one");
    aiko.patience(Duration::from_millis(200));
    let trouble = aiko.within("group", "Second").find("button", "Run").await.err().map(|trouble| trouble.0);
    let trouble = trouble.unwrap_or_default();
    assert!(
        trouble.contains("in the group \"Second\"") && trouble.contains("each button in view: \"Twin\""),
        "{trouble}"
    );
    let _ = std::fs::remove_file(aiko.failure_path());
    aiko.no_errors()
}

#[tokio::test]
async fn a_press_that_cannot_be_says_why_and_leaves_a_picture() -> Outcome<()> {
    ready!("refusals");
    let (_browser, aiko, _) = someone().await?;
    aiko.patience(Duration::from_millis(200));
    let _ = std::fs::remove_file(aiko.failure_path());
    let refusals = [
        ("Under", "covered by <div id=\"cover\""),
        ("Twin", "there are 2"),
        ("Asleep", "disabled"),
        ("Rnu", "each button in view: \"Run\""),
    ];
    for (name, why) in refusals {
        let trouble = aiko.press("button", name).await.err().map(|trouble| trouble.0).unwrap_or_default();
        assert!(trouble.contains(why), "{name} was refused with: {trouble}");
    }
    let trouble = aiko.until("1 === 2", "one is two").await.err().map(|trouble| trouble.0).unwrap_or_default();
    assert!(trouble.contains("one is two") && trouble.contains("`1 === 2` is false"), "{trouble}");
    assert!(std::fs::read(aiko.failure_path())?.starts_with(b"\x89PNG"));
    Ok(std::fs::remove_file(aiko.failure_path())?)
}

#[tokio::test]
async fn typing_makes_real_key_events() -> Outcome<()> {
    ready!("typing");
    let (_browser, aiko, _) = someone().await?;
    aiko.fill("textbox", "Name", "Björn 7.").await?;
    assert_eq!(aiko.text("textbox", "Name").await?, "Björn 7.");
    aiko.fill("textbox", "Name", "Ada").await?;
    aiko.key("Backspace").await?;
    aiko.key("Control+z").await?;
    let keys = aiko.eval("seen.keys.slice(-5).join()").await?;
    assert_eq!(keys, "A,d,a,Backspace,^z");
    aiko.key("Shift+Tab").await?;
    assert_eq!(aiko.eval("document.activeElement.tagName").await?, "BUTTON");
    aiko.no_errors()
}

#[tokio::test]
async fn dragging_works_with_mouse_pen_and_finger() -> Outcome<()> {
    ready!("dragging");
    let (_browser, aiko, _) = someone().await?;
    let start = aiko.boxed("group", "Ball").await?;
    let by = |from: (f64, f64)| (from.0 + 40.0, from.1 + 30.0);
    aiko.drag(start.centre(), by(start.centre()), 5).await?;
    aiko.pen_drag(by(start.centre()), start.centre(), 5).await?;
    assert_eq!(aiko.boxed("group", "Ball").await?, start);
    aiko.size(1024, 768, true).await?;
    let start = aiko.boxed("group", "Ball").await?;
    aiko.touch_drag(start.centre(), by(start.centre()), 5).await?;
    let end = aiko.boxed("group", "Ball").await?;
    assert_eq!((end.x, end.y), by((start.x, start.y)));
    assert_eq!(aiko.eval("[...seen.kinds].join()").await?, "mouse,pen,touch");
    aiko.no_errors()
}

#[tokio::test]
async fn fingers_tap_and_pinch() -> Outcome<()> {
    ready!("touch");
    let (_browser, aiko, _) = someone().await?;
    aiko.size(800, 600, true).await?;
    aiko.tap("button", "Run").await?;
    aiko.until("seen.clicks === 1", "the tap clicked").await?;
    aiko.pinch((500.0, 350.0), 100.0, 250.0).await?;
    assert_eq!(aiko.eval("seen.pinch").await?, 2.5);
    assert_eq!(aiko.eval("visualViewport.scale").await?, 1);
    aiko.no_errors()
}

#[tokio::test]
async fn axe_finds_a_planted_fault() -> Outcome<()> {
    ready!("axe");
    let (_browser, aiko, url) = someone().await?;
    assert_eq!(aiko.axe("", Rules::All).await?, []);
    aiko.eval("document.getElementById('one').setAttribute('style', 'color:#777;background:#888')").await?;
    for rules in [Rules::All, Rules::Colours] {
        let found = aiko.axe("main", rules).await?;
        assert_eq!(found.len(), 1, "{rules:?}: {found:?}");
        assert_eq!(found[0].rule, "color-contrast");
        assert!(found[0].nodes[0].contains("#one"), "{found:?}");
    }
    assert_eq!(aiko.axe("main", Rules::AllButColours).await?, []);
    aiko.eval("document.querySelector('main').append(document.createElement('select')), 0").await?;
    assert_eq!(aiko.axe("main", Rules::AllButColours).await?.len(), 1);
    assert_eq!(aiko.axe("main", Rules::Colours).await?.len(), 1);
    aiko.goto(&format!("{url}strict")).await?;
    aiko.forget_errors();
    aiko.axe("", Rules::All).await?;
    aiko.no_errors()
}

#[tokio::test]
async fn traffic_and_work_are_counted() -> Outcome<()> {
    ready!("counters");
    let (_browser, aiko, url) = someone().await?;
    let whole = u64::try_from(PAGE.len() + SCRIPT.len()).unwrap_or(0);
    // The end of a load is told a little later than the load event.
    for _ in 0..400 {
        if aiko.network().bytes > whole {
            break;
        }
        tokio::time::sleep(Duration::from_millis(25)).await;
    }
    let traffic = aiko.network();
    assert_eq!((traffic.requests, traffic.external.len()), (2, 0));
    assert!(traffic.bytes > whole && traffic.bytes < whole + 1000, "{traffic:?} for {whole}");
    aiko.eval(&format!("fetch('{}').catch(() => 0).then(() => 0)", url.replace("127.0.0.1", "localhost"))).await?;
    assert_eq!(aiko.network().external.len(), 1);
    let before = aiko.cpu_ms().await?;
    // An amount of work, not of time: a busy machine gives it less of each second.
    aiko.eval("(() => { let sum = 0; for (let i = 0; i < 1e8; i++) sum += Math.sqrt(i); return sum; })()").await?;
    let spent = aiko.cpu_ms().await? - before;
    assert!(spent > 10.0, "{spent} ms");
    Ok(())
}

#[tokio::test]
async fn every_kind_of_error_is_noticed() -> Outcome<()> {
    ready!("errors");
    let (_browser, aiko, url) = someone().await?;
    aiko.no_errors()?;
    aiko.eval("console.error('said', 7)").await?;
    aiko.eval("setTimeout(() => { throw new Error('thrown') }); 0").await?;
    aiko.eval("fetch('/missing').then(() => 0)").await?;
    // A rejection that nobody handles is told after the script, and not at all by a page that is left before.
    aiko.eval(
        "new Promise(done => {
            addEventListener('unhandledrejection', () => done(true));
            Promise.reject(new Error('rejected'));
        })",
    )
    .await?;
    aiko.goto(&format!("{url}strict")).await?;
    let all = aiko.errors().join("\n");
    for word in ["said 7", "thrown", "404", "rejected", "Content Security Policy"] {
        assert!(all.contains(word), "no `{word}` in:\n{all}");
    }
    assert!(aiko.no_errors().is_err());
    aiko.forget_errors();
    aiko.no_errors()
}

#[tokio::test]
async fn two_people_share_nothing_and_two_tabs_share_all() -> Outcome<()> {
    ready!("two people");
    let (browser, aiko, url) = someone().await?;
    let ben = browser.person("ben").await?;
    let tab = browser.second_tab(&aiko, "aiko-again").await?;
    ben.goto(&url).await?;
    tab.goto(&url).await?;
    aiko.eval("localStorage.setItem('mine', 'yes')").await?;
    assert_eq!(tab.eval("localStorage.getItem('mine')").await?, "yes");
    assert!(ben.eval("localStorage.getItem('mine')").await?.is_null());
    for page in [&aiko, &ben, &tab] {
        assert_eq!(page.eval("document.hasFocus() && document.visibilityState").await?, "visible");
        page.eval("new Promise(requestAnimationFrame).then(() => 1)").await?;
    }
    tab.close().await?;
    ben.reload().await?;
    ben.no_errors()
}

#[tokio::test]
async fn of_one_test_nothing_is_left_in_the_browser_of_the_next() -> Outcome<()> {
    ready!("a browser that is taken over");
    // More than once, as tests beside this one take browsers over and give them back too.
    for round in 0..4 {
        let (browser, aiko, url) = someone().await?;
        let ben = browser.person("ben").await?;
        ben.goto(&url).await?;
        assert_eq!(browser.people().await?, 2, "in round {round}");
        // Cookies do not know ports: that of the round before would be here.
        for page in [aiko, ben] {
            assert_eq!(page.eval("document.cookie").await?, "", "in round {round}");
            page.eval("document.cookie = 'left=yes'").await?;
        }
    }
    Ok(())
}

#[tokio::test]
async fn the_page_is_shown_as_asked() -> Outcome<()> {
    ready!("looks");
    let (_browser, aiko, _) = someone().await?;
    let background = "getComputedStyle(document.body).backgroundColor";
    aiko.theme(true).await?;
    aiko.media("prefers-reduced-motion", "reduce").await?;
    assert_eq!(aiko.eval(background).await?, "rgb(17, 17, 17)");
    assert_eq!(aiko.eval("matchMedia('(prefers-reduced-motion: reduce)').matches").await?, true);
    aiko.theme(false).await?;
    assert_eq!(aiko.eval(background).await?, "rgba(0, 0, 0, 0)");
    aiko.size(400, 700, true).await?;
    assert_eq!(aiko.eval("[innerWidth, innerHeight].join()").await?, "400,700");
    let folder = house::folder()?;
    let path = folder.path().join("deep/page.png");
    aiko.screenshot(&path).await?;
    assert!(std::fs::read(path)?.starts_with(b"\x89PNG"));
    Ok(())
}

#[cfg(unix)]
#[tokio::test]
async fn a_chromium_that_draws_nothing_draws_again() -> Outcome<()> {
    ready!("frames");
    let (_browser, aiko, _) = someone().await?;
    aiko.frames().await?;
    let drawing = aiko.drawing_process().await?;
    assert!(std::process::Command::new("kill").args(["-STOP", &drawing.to_string()]).status()?.success());
    aiko.size(400, 700, true).await?;
    aiko.frames().await?;
    assert_ne!(aiko.drawing_process().await?, drawing, "it was started anew");
    let folder = house::folder()?;
    aiko.screenshot(&folder.path().join("page.png")).await
}

#[tokio::test]
async fn a_page_that_hangs_is_told() -> Outcome<()> {
    ready!("a page that hangs");
    let (_browser, aiko, _) = someone().await?;
    aiko.eval("setTimeout(() => { for (;;) {} })").await?;
    let told = aiko.frames().await.expect_err("it hangs").to_string();
    assert!(told.contains("its scripts do not run, and its process worked"), "{told}");
    Ok(())
}

fn fake() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/harness/fake-server.sh"))
}

#[tokio::test]
async fn a_server_is_started_ended_and_started_again() -> Outcome<()> {
    let folder = house::folder()?;
    let data = folder.path().join("data");
    let mut server = Server::start_binary(fake(), &data, &["--seed", "x"]).await?;
    assert_eq!((server.url().as_str(), server.address()), ("http://127.0.0.1:4242/", "127.0.0.1:4242"));
    let line = server.said("logs:").await?;
    assert_eq!(line, format!("logs: serve --listen 127.0.0.1:0 --data {} --seed x", data.display()));
    server.terminate().await?;
    server.said("asked to end").await?;
    assert!(server.terminate().await.is_err());
    server.restart().await?;
    server.said("--listen 127.0.0.1:4242").await?;
    server.kill9().await?;
    server.restart().await?;
    let id = server.id().ok_or("the server runs")?;
    drop(server);
    gone(id).await
}

#[tokio::test]
async fn a_server_that_fails_shows_its_log() -> Outcome<()> {
    let folder = house::folder()?;
    let trouble = Server::start_binary(fake(), folder.path(), &["broken"]).await.err();
    let trouble = trouble.map(|trouble| trouble.0).unwrap_or_default();
    assert!(trouble.contains("before it was ready") && trouble.contains("the disk is gone"), "{trouble}");
    let mut rude = Server::start_binary(fake(), folder.path(), &["rude"]).await?;
    let trouble = rude.terminate().await.err().map(|trouble| trouble.0).unwrap_or_default();
    assert!(trouble.contains("exit status: 7"), "{trouble}");
    Ok(())
}

/// Waits until the process `id` is no more.
async fn gone(id: u32) -> Outcome<()> {
    for _ in 0..400 {
        let alive = std::process::Command::new("kill").args(["-0", &id.to_string()]).output()?;
        if !alive.status.success() {
            return Ok(());
        }
        tokio::time::sleep(Duration::from_millis(25)).await;
    }
    Err("the process lives on".into())
}
