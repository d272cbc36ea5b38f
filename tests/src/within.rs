//! A part of the page: what is looked for or pressed is meant in there and nowhere else.

use crate::Outcome;
use crate::find::Node;
use crate::page::Page;

/// A part of a page, by role and name: a dialog, a toolbar, a list.
#[derive(Clone, Copy)]
pub struct Within<'a> {
    page: &'a Page,
    role: &'a str,
    name: &'a str,
}

impl Page {
    /// Only what is inside the one element with this role and accessible name.
    pub fn within<'a>(&'a self, role: &'a str, name: &'a str) -> Within<'a> {
        Within { page: self, role, name }
    }
}

impl Within<'_> {
    fn inside(&self) -> Option<(&str, &str)> {
        Some((self.role, self.name))
    }

    /// Finds as [`Page::find`] does.
    pub async fn find(&self, role: &str, name: &str) -> Outcome<Node> {
        self.page.find_in(self.inside(), role, name).await
    }

    /// Finds as [`Page::find_all`] does.
    pub async fn find_all(&self, role: &str, name: &str) -> Outcome<Vec<Node>> {
        self.page.find_all_in(self.inside(), role, name).await
    }

    /// Reads as [`Page::text`] does.
    pub async fn text(&self, role: &str, name: &str) -> Outcome<String> {
        self.page.text_in(self.inside(), role, name).await
    }

    /// Presses as [`Page::press`] does.
    pub async fn press(&self, role: &str, name: &str) -> Outcome<()> {
        let at = self.page.reach_in(self.inside(), role, name).await?;
        self.page.press_at(at).await
    }

    /// Taps as [`Page::tap`] does.
    pub async fn tap(&self, role: &str, name: &str) -> Outcome<()> {
        let at = self.page.reach_in(self.inside(), role, name).await?;
        self.page.tap_at(at).await
    }

    /// Measures as [`Page::hit_size`] does.
    pub async fn hit_size(&self, role: &str, name: &str) -> Outcome<(f64, f64)> {
        let at = self.page.reach_in(self.inside(), role, name).await?;
        self.page.hit_size_at(at).await
    }

    /// Fills as [`Page::fill`] does.
    pub async fn fill(&self, role: &str, name: &str, text: &str) -> Outcome<()> {
        self.press(role, name).await?;
        self.page.key("Control+a").await?;
        self.page.key("Delete").await?;
        self.page.type_text(text).await
    }
}
