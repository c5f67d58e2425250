//! Pages of `motet explain`: one per code, with an example that raises it and a corrected one. Tests run
//! both.

use motet_syntax::Code;

/// Page of one diagnostic code.
#[derive(Clone, Copy, Debug)]
pub struct CodePage {
    pub code: &'static str,
    /// Markdown: the meaning, an example that raises the code, and one that does not.
    pub text: &'static str,
}

macro_rules! pages {
    ($($code:literal)*) => {
        &[$(CodePage { code: $code, text: include_str!(concat!("../codes/", $code, ".md")) }),*]
    };
}

/// All pages, sorted by code.
pub const PAGES: &[CodePage] = pages! {
    "M0101" "M0102" "M0103" "M0104" "M0105" "M0106" "M0107" "M0108" "M0109" "M0110" "M0111" "M0112"
    "M0113" "M0114" "M0115" "M0116" "M0117" "M0118" "M0119" "M0120" "M0121" "M0122" "M0123" "M0124"
    "M0131" "M0132" "M0133" "M0141" "M0142" "M0143"
    "M0201" "M0202" "M0203" "M0204" "M0205" "M0206" "M0207" "M0208" "M0209" "M0210" "M0211" "M0212"
    "M0213" "M0214" "M0215" "M0216" "M0217" "M0218" "M0221" "M0222" "M0223" "M0224" "M0225" "M0226"
    "M0301" "M0302" "M0303" "M0304" "M0305" "M0306" "M0307" "M0308" "M0309" "M0310" "M0311" "M0312"
    "M0313" "M0314" "M0315" "M0316" "M0317" "M0318" "M0319" "M0320" "M0321"
    "M0401" "M0402" "M0403" "M0404" "M0405" "M0406" "M0407" "M0408" "M0409" "M0410" "M0411" "M0412"
    "M0413" "M0414" "M0415" "M0416" "M0417" "M0418" "M0419" "M0420" "M0421" "M0422" "M0423" "M0424"
    "M0425" "M0426" "M0427" "M0428" "M0429" "M0430" "M0431" "M0432" "M0433" "M0434" "M0435" "M0436"
    "M0437" "M0438" "M0439" "M0440" "M0441" "M0442" "M0443" "M0444" "M0445" "M0446" "M0447" "M0448"
    "M0449" "M0450" "M0451" "M0452" "M0453" "M0454" "M0455" "M0456" "M0457" "M0458" "M0459" "M0460"
    "M0461" "M0462" "M0463" "M0464" "M0465" "M0466" "M0467" "M0468" "M0469" "M0470" "M0471" "M0472"
    "M0473" "M0474" "M0475" "M0476" "M0477" "M0478" "M0479" "M0480" "M0481" "M0482" "M0483" "M0484"
    "M0485" "M0486" "M0487" "M0488"
    "M0501" "M0502" "M0503" "M0504" "M0505" "M0506"
    "M0601" "M0602" "M0603" "M0604" "M0605" "M0606" "M0607" "M0608" "M0609" "M0610" "M0611"
    "M0701" "M0702"
    "M0801" "M0802" "M0803" "M0804" "M0805"
    "M0901" "M0902" "M0903" "M0904" "M0905" "M0906" "M0907" "M0908" "M0909" "M0910" "M0911" "M0912"
};

/// Page of a code; the case of letters does not matter. O(pages).
///
/// ```
/// let page = motet_compiler::explain_pages::page("m0501").expect("a known code");
/// assert!(page.text.starts_with("# M0501: "));
/// ```
#[must_use]
pub fn page(code: &str) -> Option<&'static CodePage> {
    PAGES.iter().find(|page| page.code.eq_ignore_ascii_case(code))
}

/// All codes that the front ends, the readers of cards and scenes, and the compiler can raise, sorted.
#[must_use]
pub fn all() -> Vec<Code> {
    let stages = [
        motet_pddl::CODES,
        motet_btcpp::CODES,
        crate::declare::diagnostics::CODES,
        crate::resolve::diagnostics::CODES,
        crate::environment::CODES,
        motet_robots::card::CODES,
        motet_robots::mesh::CODES,
        motet_robots::import::CODES,
        motet_robots::scene::CODES,
        motet_robots::urdf::CODES,
        motet_robots::srdf::CODES,
        crate::limits::diagnostics::CODES,
        crate::prove::diagnostics::CODES,
        crate::feasibility::diagnostics::CODES,
    ];
    let front_end = motet_syntax::diagnostics::CODES;
    let mut codes: Vec<_> = front_end.into_iter().chain(stages).flatten().copied().collect();
    codes.sort_unstable();
    codes
}
