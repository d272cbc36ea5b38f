//! The permissions of every way in. Nothing that is asked is left out: requests have their role in the table of the protocol,
//! and whoever adds a route is asked here by the compiler.

use super::entry::MinimumRole;
use protocol::{AnyRequest, HOST_LINK_PATH, JOIN_PATH, PATH, RECORDINGS_PATH, REPORTS_PATH, Role, STOP_PATH, request};

/// An operation that somebody asks for, by whatever way.
#[derive(Clone, Copy, Debug)]
pub(crate) enum AskedOperation<'a> {
    /// Over a socket.
    Socket(&'a AnyRequest),
    /// Over HTTP.
    Http(Route),
    /// Over a socket: removing a robot that is none of the simulated ones.
    RemoveRealRobot,
    /// Over a socket: adding a robot where few places for one are left.
    LastRobot,
}

/// Every route of the server.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Route {
    /// The page, and every path that is none of the others.
    Page,
    /// The page of an invitation's link, what it looks like and does, and the exchange of its token.
    Join,
    /// The sheet of that page.
    JoinStyle,
    /// The script of that page.
    JoinScript,
    /// The name of who invites by a link, and what for.
    Invitation,
    /// Opening a socket.
    Socket,
    /// Asks if the server is there.
    Health,
    /// Asks if its store is.
    Ready,
    /// The names of the behaviours.
    List,
    /// A behaviour as a file.
    Download,
    /// Everything in one file.
    Backup,
    /// The recordings.
    Recordings,
    /// One of them.
    Recording,
    /// The recordings as a page.
    RecordingList,
    /// Naming one, putting it into the bin, bringing it back, and changing its marks.
    ChangeRecording,
    /// The report of one, as a page.
    Report,
    /// The stylesheet of reports.
    ReportStyle,
    /// The stylesheet of the recordings as a page.
    RecordingListStyle,
    /// The script of reports.
    ReportScript,
    /// The next picture of a robot's camera.
    Camera,
    /// Bringing a behaviour in.
    Import,
    /// Stop.
    Stop,
    /// A link for another browser of the host.
    HostLink,
    /// The senses and actions of robots.
    Catalogue,
    /// The sheet of that page.
    CatalogueStyle,
}

impl Route {
    /// All of them.
    pub(crate) const ALL: [Self; 25] = [
        Self::Page,
        Self::Join,
        Self::JoinStyle,
        Self::JoinScript,
        Self::Invitation,
        Self::Socket,
        Self::Health,
        Self::Ready,
        Self::List,
        Self::Download,
        Self::Backup,
        Self::Recordings,
        Self::Recording,
        Self::RecordingList,
        Self::ChangeRecording,
        Self::Report,
        Self::ReportStyle,
        Self::RecordingListStyle,
        Self::ReportScript,
        Self::Camera,
        Self::Import,
        Self::Stop,
        Self::HostLink,
        Self::Catalogue,
        Self::CatalogueStyle,
    ];

    /// The path of the route; none for the page, which is what is left.
    pub(crate) fn path(self) -> Option<String> {
        let path = match self {
            Self::Page => return None,
            Self::Join => JOIN_PATH,
            Self::JoinStyle => "/come-in.css",
            Self::JoinScript => "/come-in.js",
            Self::Invitation => "/come-in/invitation",
            Self::Socket => PATH,
            Self::Health => "/healthz",
            Self::Ready => "/readyz",
            Self::List => "/api/behaviours",
            Self::Download => "/api/behaviours/{file}",
            Self::Backup => "/api/backup",
            Self::Recordings => RECORDINGS_PATH,
            Self::Recording => return Some(format!("{RECORDINGS_PATH}/{{file}}")),
            Self::Report => return Some(format!("{REPORTS_PATH}/{{file}}/report")),
            Self::RecordingList => REPORTS_PATH,
            Self::ChangeRecording => return Some(format!("{REPORTS_PATH}/{{file}}/change")),
            Self::ReportStyle => "/report.css",
            Self::RecordingListStyle => "/recordings.css",
            Self::ReportScript => "/report.js",
            Self::Camera => "/api/robots/{robot}/camera",
            Self::Import => "/api/import",
            Self::Stop => STOP_PATH,
            Self::HostLink => HOST_LINK_PATH,
            Self::Catalogue => "/catalogue",
            Self::CatalogueStyle => "/catalogue.css",
        };
        Some(path.to_owned())
    }
}

/// The least that somebody must be to ask this.
pub(crate) fn least(asked: &AskedOperation) -> MinimumRole {
    match asked {
        AskedOperation::Socket(request) => MinimumRole::In(of_request(request)),
        AskedOperation::Http(route) => of_route(*route),
        // Only the host can bring a real robot back, and has to find a place for one.
        AskedOperation::RemoveRealRobot | AskedOperation::LastRobot => MinimumRole::In(Role::Host),
    }
}

fn of_route(route: Route) -> MinimumRole {
    match route {
        Route::Join | Route::JoinStyle | Route::JoinScript | Route::Invitation | Route::Health => MinimumRole::Anyone,
        Route::Page
        | Route::Socket
        | Route::Ready
        | Route::List
        | Route::Download
        | Route::Recordings
        | Route::Recording
        | Route::Report
        | Route::RecordingList
        | Route::RecordingListStyle
        | Route::ReportStyle
        | Route::ReportScript
        | Route::Catalogue
        | Route::CatalogueStyle
        | Route::Stop => MinimumRole::In(Role::Viewer),
        // A picture of people is for who works with them.
        Route::Camera | Route::ChangeRecording => MinimumRole::In(Role::Operator),
        Route::Backup | Route::Import => MinimumRole::In(Role::Editor),
        Route::HostLink => MinimumRole::In(Role::Host),
    }
}

/// As the table of requests says; what reaches out into the network from this computer is the host's.
fn of_request(request: &AnyRequest) -> Role {
    match request {
        AnyRequest::AddRobot(request::AddRobot { real: Some(_), .. }) => Role::Host,
        other => other.row().role,
    }
}
