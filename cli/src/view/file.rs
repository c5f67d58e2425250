//! Files of the page, and a page with its items in one file.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use motet_syntax::render::escaped_json;
use sha2::{Digest as _, Sha256};

use super::hub::Item;

/// Document of the page.
pub(crate) const HTML: &str = include_str!("../../assets/view.html");
/// Script, bundled from the sources in `view/`.
pub(crate) const SCRIPT: &str = include_str!("../../assets/view.js");
pub(crate) const STYLE: &str = include_str!("../../assets/view.css");
/// Licences of the libraries in the script.
pub(crate) const LICENSES: &str = include_str!("../../assets/view.licenses.txt");

/// Page in one file that shows these items and loads nothing. Its policy admits this script and style only.
pub(crate) fn whole(items: &[Item]) -> String {
    let hash = |text: &str| STANDARD.encode(Sha256::digest(text.as_bytes()));
    let policy = format!(
        "default-src 'none'; script-src 'sha256-{}'; style-src 'sha256-{}'; img-src data:; base-uri 'none'; \
         form-action 'none'",
        hash(SCRIPT),
        hash(STYLE)
    );
    let items: Vec<&str> = items.iter().map(|item| &*item.json).collect();
    // In a script element, `<` could begin its end.
    let items = escaped_json(&format!("[{}]", items.join(",\n"))).replace('<', "\\u003c");
    let data = format!("<script type=\"application/json\" id=\"items\">{items}</script>");
    let meta = format!("<meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">");
    HTML.replace("<!-- policy -->", &meta)
        .replace("<link rel=\"stylesheet\" href=\"view.css\">", &format!("<style>{STYLE}</style>"))
        .replace("<!-- items -->", &data)
        .replace("<script src=\"view.js\" defer></script>", "")
        .replace("</body>", &format!("<script>{SCRIPT}</script></body>"))
}

#[cfg(test)]
mod tests {
    use super::{HTML, SCRIPT, STYLE, whole};
    use crate::view::hub::Hub;

    #[test]
    fn page_has_the_places_for_its_parts() {
        for part in ["<!-- policy -->", "<!-- items -->", "href=\"view.css\"", "src=\"view.js\"", "</body>"] {
            assert_eq!(HTML.matches(part).count(), 1, "{part}");
        }
        // The file of a page holds them as they are.
        assert!(!SCRIPT.contains("</script") && !STYLE.contains("</style"));
    }

    #[test]
    fn file_keeps_items_inside_their_element() {
        let hub = Hub::default();
        hub.push("1-0", &serde_json::json!({"text": "</script><script>alert(1)</script><!--"}));
        let page = whole(&hub.all());
        assert!(!page.contains("alert(1)</script>"));
        assert!(page.contains("\\u003c/script>\\u003cscript>alert(1)"));
        assert!(!page.contains("src=\"view.js\"") && !page.contains("href=\"view.css\""));
    }
}
