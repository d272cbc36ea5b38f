//! The routes.

use super::door::RequestArrival;
use super::downloads::{Downloads, few_at_once};
use super::headers::{HEADERS, is_needed};
use super::join::BrowserLanguage;
use super::page::PageFiles;
use super::readiness::Readiness;
use super::{camera, catalogue, cut, join, page, recording_list, recordings, report, stop, transfer, upload};
use crate::connection::{Connections, NoPlace, session};
use crate::invitations::{AskedOperation, Identified, Route};
use crate::state::ServerState;
use crate::support::identity::Sender;
use crate::support::shares::{ShareLimits, SharedPlaces};
use crate::support::tasks::boxed;
use axum::Router;
use axum::extract::{DefaultBodyLimit, Form, Path, Query, Request, State, WebSocketUpgrade};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, Uri, header};
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Redirect, Response};
use axum::routing::{MethodRouter, any, get, post};
use axum::{Extension, Json};
use protocol::{MESSAGE_MAX_BYTES, OPERATE_PATH, Refused, Role};
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;
use store::files::FILE_MAX_BYTES;
use tokio::runtime::Handle;
use tower_http::set_header::SetResponseHeaderLayer;
use tower_http::timeout::{RequestBodyTimeoutLayer, TimeoutLayer};
use tower_http::trace::TraceLayer;

/// What may wait to be written to one socket, in bytes: some large messages; then its writer waits.
const WRITE_MAX_BYTES: usize = 16 << 20;
/// What is read of a socket at once, in bytes: almost every message is smaller, and every socket keeps that much.
const READ_BYTES: usize = 8 << 10;

/// How long a request may take to be answered; a download may take longer once it began.
const REQUEST_MS: u64 = 60_000;
/// Files that may be on their way to us.
const UPLOADS: ShareLimits = ShareLimits { all: 8, guest: 2, host: 8, reserved: 2, still_ms: 0 };
/// The longest form that changes a recording, in bytes.
const FORM_MAX_BYTES: usize = 8 << 10;
/// The longest form with a token, in bytes.
const TOKEN_MAX_BYTES: usize = 1 << 10;
/// What who gets no place for a socket is told.
const TOO_MANY_PAGES: &str = "Too many pages are open. Close some.\n";
const TOO_OFTEN: &str = "You opened too many pages just now. Wait a moment.\n";
/// How long the next piece of a request may take to come.
const PIECE_MS: u64 = 5_000;

/// Tells a program at this computer that it shows no secret of it.
const NOT_THE_HOST: &str = "Only the host may do this. Run rrp as the user who runs the server, or open the link that \
                            `rrp open` prints in this browser.\n";

/// What the routes work with.
#[derive(Clone)]
struct AppState {
    connections: Arc<Connections>,
    /// Places for what people download.
    downloads: Downloads,
    /// Places for who looks through a camera.
    looks: Arc<SharedPlaces>,
    /// Files that are being sent to us.
    uploads: Arc<SharedPlaces>,
    /// Whether the store can save, as it was found lately.
    readiness: Readiness,
    /// The threads that carry messages.
    messages: Handle,
    page: PageFiles,
    /// Where this computer reaches the server.
    address: SocketAddr,
}

impl AppState {
    /// For whom a request is done.
    fn sender(&self, entry: &Identified) -> Sender {
        entry.identity().asks(self.connections.number())
    }

    fn state(&self) -> &Arc<ServerState> {
        &self.connections.state
    }
}

/// All routes; sockets are served on `messages`.
pub(crate) fn routes(connections: Arc<Connections>, messages: Handle, page: PageFiles, address: SocketAddr) -> Router {
    let (downloads, uploads) = (Downloads::default(), SharedPlaces::within(UPLOADS));
    let readiness = Readiness::default();
    let looks = SharedPlaces::within(camera::LOOKS);
    let app = AppState { connections, downloads, looks, uploads, readiness, messages, page, address };
    let add = |router: Router<AppState>, route: Route| {
        let handler = match route {
            // It asks itself, as on the accepting thread.
            Route::Stop => handler(route, &app),
            _ => handler(route, &app).layer(middleware::from_fn_with_state(route, ask_role)),
        };
        match route.path() {
            Some(path) => router.route(&path, handler),
            None => router.fallback(handler),
        }
    };
    let router = Route::ALL.into_iter().fold(Router::new(), add);
    let router = router
        .layer(RequestBodyTimeoutLayer::new(Duration::from_millis(PIECE_MS)))
        .layer(TimeoutLayer::with_status_code(StatusCode::REQUEST_TIMEOUT, Duration::from_millis(REQUEST_MS)))
        .layer(middleware::from_fn(guard_all))
        .with_state(app);
    with_headers(router)
}

/// What answers a route.
fn handler(route: Route, app: &AppState) -> MethodRouter<AppState> {
    let few_at_once = middleware::from_fn_with_state(app.downloads.clone(), few_at_once);
    let handler = match route {
        Route::Page => get(files),
        Route::Join => get(async |Extension(came): Extension<RequestArrival>, headers: HeaderMap| {
            join::page(&came, BrowserLanguage::of(&headers))
        })
        .post(enter)
        .layer(DefaultBodyLimit::max(TOKEN_MAX_BYTES)),
        Route::JoinStyle => get(|| async { join::style() }),
        Route::JoinScript => get(|| async { join::script() }),
        Route::Invitation => {
            let ask = async |Extension(came): Extension<RequestArrival>, request: Request| {
                join::invitation(came, request).await
            };
            post(ask).layer(DefaultBodyLimit::max(TOKEN_MAX_BYTES))
        }
        Route::Socket => any(socket),
        Route::Catalogue => get(|| async { catalogue::page() }),
        Route::CatalogueStyle => get(|| async { catalogue::style() }),
        Route::Health => get(|| async { "ok\n" }),
        Route::Ready => get(readyz),
        Route::List => get(list).layer(few_at_once),
        Route::Download => get(download).layer(few_at_once),
        Route::Backup => get(backup).layer(few_at_once),
        Route::Recordings => get(list_recordings).layer(few_at_once),
        Route::Recording => get(recording).layer(few_at_once),
        Route::RecordingList => get(recording_page).layer(few_at_once),
        Route::RecordingListStyle => get(|| async { recording_list::style() }),
        Route::ChangeRecording => post(change_recording).layer(DefaultBodyLimit::max(FORM_MAX_BYTES)),
        Route::Report => get(session_report).layer(few_at_once),
        Route::ReportStyle => get(|| async { report::style() }),
        Route::ReportScript => get(|| async { report::script() }),
        Route::Camera => get(camera),
        Route::Import => post(import).layer(DefaultBodyLimit::max(FILE_MAX_BYTES)),
        // Nothing more is added to the way of Stop.
        Route::Stop => return post(stop),
        Route::HostLink => post(host_link),
    };
    // What fails says so itself, in its own words.
    handler.layer(TraceLayer::new_for_http().on_failure(()))
}

/// Puts the headers on every answer, whoever gives it.
fn with_headers(router: Router) -> Router {
    HEADERS.into_iter().fold(router, |router, (name, value)| {
        let (name, value) = (HeaderName::from_static(name), HeaderValue::from_static(value));
        router.layer(SetResponseHeaderLayer::overriding(name.clone(), move |answer: &Response| {
            let kind = answer.headers().get(header::CONTENT_TYPE).and_then(|kind| kind.to_str().ok());
            is_needed(name.as_str(), kind).then(|| value.clone())
        }))
    })
}

/// Lets in only what the guard lets in, and finds out as whom its sender is in. Stop asks that in its own way.
async fn guard_all(Extension(came): Extension<RequestArrival>, mut request: Request, next: Next) -> Response {
    if request.method() == Method::POST && request.uri().path() == protocol::STOP_PATH {
        return next.run(request).await;
    }
    match came.door.may_enter(&request) {
        Ok(()) => {
            let entry = came.entry(request.headers());
            request.extensions_mut().insert(entry);
            next.run(request).await
        }
        Err(why) => {
            tracing::warn!(%why, "a request was turned away");
            (StatusCode::FORBIDDEN, format!("Refused: {why}.\n")).into_response()
        }
    }
}

/// Lets in who may ask for a route; whose invitation ends meanwhile is cut off.
async fn ask_role(State(route): State<Route>, request: Request, next: Next) -> Response {
    let tunnel = request.extensions().get::<RequestArrival>().and_then(|came| came.door.tunnel(request.headers()));
    let entry = request.extensions().get::<Identified>().cloned().unwrap_or(Identified::Stranger);
    let language = BrowserLanguage::of(request.headers());
    let no = match entry.may(AskedOperation::Http(route)) {
        Ok(()) => {
            let answer = tokio::select! {
                answer = next.run(request) => answer,
                () = entry.until_over() => return (StatusCode::FORBIDDEN, format!("{}\n", Refused::NotInvited)).into_response(),
            };
            return answer.map(|body| cut::until_over(body, entry));
        }
        Err(no) => no,
    };
    match (entry, route) {
        (Identified::Stranger, Route::Page) => join::ask_for_one(language),
        (Identified::Unproven, Route::Page) => join::ask_for_link(language, tunnel),
        (Identified::Unproven, _) => (StatusCode::UNAUTHORIZED, NOT_THE_HOST).into_response(),
        (Identified::Stranger, _) => {
            (StatusCode::UNAUTHORIZED, "Only who was invited may come in here.\n").into_response()
        }
        (Identified::Host | Identified::Guest(_), _) => (StatusCode::FORBIDDEN, format!("{no}\n")).into_response(),
    }
}

async fn enter(
    State(app): State<AppState>,
    Extension(came): Extension<RequestArrival>,
    Extension(entry): Extension<Identified>,
    request: Request,
) -> Response {
    join::join(came, &entry, &app.state().files, request).await
}

async fn socket(
    State(app): State<AppState>,
    Extension(entry): Extension<Identified>,
    upgrade: WebSocketUpgrade,
) -> Response {
    let seat = match app.connections.place(&entry.identity()) {
        Ok(seat) => seat,
        Err(NoPlace::TooMany) => return (StatusCode::SERVICE_UNAVAILABLE, TOO_MANY_PAGES).into_response(),
        Err(NoPlace::TooOften) => return (StatusCode::TOO_MANY_REQUESTS, TOO_OFTEN).into_response(),
    };
    let upgrade = upgrade.max_message_size(MESSAGE_MAX_BYTES).max_frame_size(MESSAGE_MAX_BYTES);
    let upgrade = upgrade.read_buffer_size(READ_BYTES).write_buffer_size(0).max_write_buffer_size(WRITE_MAX_BYTES);
    upgrade.on_upgrade(move |socket| async move {
        let tasks = app.connections.state.tasks.clone();
        let _ = tasks.spawn_on(boxed(session::run(app.connections, socket, entry, seat)), &app.messages).await;
    })
}

/// Makes a link by which another browser of this computer becomes the host's.
async fn host_link(State(app): State<AppState>) -> Response {
    match app.state().host.new_link(app.address) {
        Some(link) => Json(serde_json::json!({ "link": link })).into_response(),
        None => (StatusCode::SERVICE_UNAVAILABLE, "This computer gives no random numbers.\n").into_response(),
    }
}

/// The accepting thread answers almost every Stop; this one is for requests that are written in another way.
async fn stop(
    State(app): State<AppState>,
    Extension(came): Extension<RequestArrival>,
    uri: Uri,
    asked: HeaderMap,
) -> Response {
    stop::press(&came.door, &app.state().robots, &uri, &asked).into_response()
}

async fn readyz(State(app): State<AppState>) -> Response {
    match app.readiness.ask(&*app.state().store).await {
        Ok(()) => "ready\n".into_response(),
        Err(error) => (StatusCode::SERVICE_UNAVAILABLE, format!("{error}\n")).into_response(),
    }
}

async fn list(State(app): State<AppState>, Extension(entry): Extension<Identified>) -> Response {
    transfer::list(app.state(), &app.sender(&entry)).await
}

async fn backup(State(app): State<AppState>, Extension(entry): Extension<Identified>) -> Response {
    transfer::backup(app.state(), app.sender(&entry))
}

async fn list_recordings(State(app): State<AppState>, Extension(entry): Extension<Identified>) -> Response {
    recordings::list(app.state().recordings.clone(), (&app.state().files, app.sender(&entry))).await
}

async fn recording(
    State(app): State<AppState>,
    Extension(entry): Extension<Identified>,
    Path(file): Path<String>,
    Query(wanted): Query<report::ReportQuery>,
) -> Response {
    match wanted.form() {
        None => {}
        Some(Err(no)) => return no,
        Some(Ok(form)) => {
            let analyses = (&app.state().analyses, app.sender(&entry));
            return report::converted(app.state().recordings.clone(), analyses, (file, form, wanted)).await;
        }
    }
    let files = (app.state().files.clone(), app.sender(&entry));
    recordings::download(app.state().recordings.clone(), files, file).await
}

async fn recording_page(
    State(app): State<AppState>,
    Extension(entry): Extension<Identified>,
    Query(wanted): Query<recording_list::ListQueryWanted>,
    headers: HeaderMap,
) -> Response {
    let may_change = entry.may(AskedOperation::Http(Route::ChangeRecording)).is_ok();
    let analyses = (&app.state().analyses, app.sender(&entry));
    let asked = (wanted, BrowserLanguage::of(&headers), may_change);
    recording_list::page(app.state().recordings.clone(), analyses, asked).await
}

async fn change_recording(
    State(app): State<AppState>,
    Extension(entry): Extension<Identified>,
    Path(file): Path<String>,
    headers: HeaderMap,
    Form(change): Form<recording_list::ListForm>,
) -> Response {
    let by = match &entry {
        Identified::Guest(guest) => app.state().invitations.name_of(guest),
        Identified::Host | Identified::Unproven | Identified::Stranger => recording_list::HOST.to_owned(),
    };
    let files = (&app.state().files, app.sender(&entry));
    let asked = (file, change, by, BrowserLanguage::of(&headers));
    recording_list::change(app.state().recordings.clone(), files, asked).await
}

async fn session_report(
    State(app): State<AppState>,
    Extension(entry): Extension<Identified>,
    Path(file): Path<String>,
    Query(wanted): Query<report::ReportQuery>,
    headers: HeaderMap,
) -> Response {
    let (recordings, knowing) = (app.state().recordings.clone(), Arc::clone(&app.state().knowing));
    let analyses = (&app.state().analyses, app.sender(&entry));
    report::page(recordings, knowing, analyses, (file, wanted, BrowserLanguage::of(&headers))).await
}

async fn download(
    State(app): State<AppState>,
    Extension(entry): Extension<Identified>,
    Path(file): Path<String>,
) -> Response {
    transfer::download(app.state(), app.sender(&entry), &file).await
}

async fn camera(
    State(app): State<AppState>,
    Extension(entry): Extension<Identified>,
    Path(robot): Path<String>,
) -> Response {
    let Some(_place) = app.looks.take(&entry.identity()) else {
        return (StatusCode::SERVICE_UNAVAILABLE, format!("{}\n", Refused::TooFast)).into_response();
    };
    camera::next(app.state(), &robot).await
}

async fn import(
    State(app): State<AppState>,
    Extension(entry): Extension<Identified>,
    Query(how): Query<upload::ImportHow>,
    request: Request,
) -> Response {
    let how = match &entry {
        // Whatever they say: a guest is who they are here.
        Identified::Guest(guest) => upload::ImportHow { by: app.state().invitations.name_of(guest), ..how },
        Identified::Host | Identified::Unproven | Identified::Stranger => how,
    };
    let Some(place) = app.uploads.take(&entry.identity()) else {
        return (StatusCode::SERVICE_UNAVAILABLE, format!("{}\n", Refused::TooFast)).into_response();
    };
    upload::upload(&app.state().library, &place, app.sender(&entry), how, request).await
}

async fn files(
    State(app): State<AppState>,
    Extension(entry): Extension<Identified>,
    method: Method,
    uri: Uri,
    asked: HeaderMap,
) -> Response {
    debug_assert!(method.is_safe());
    // Operators land where they operate; the way out of there says so in its query.
    if entry.role() == Some(Role::Operator) && uri.path() == "/" && uri.query().is_none() {
        return ([(header::CACHE_CONTROL, "no-store")], Redirect::to(OPERATE_PATH)).into_response();
    }
    page::answer(app.page, uri.path(), &asked)
}
