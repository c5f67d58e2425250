//! Properties of graphs: they validate, round trip, hash and draw alike; mutated ones are refused or stay
//! harmless.

use motet_arbitrary::graph::graphs;
use motet_graph::{NodeId, RegionId, decode, draw, encode, hash, validate};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn sketched_graph_is_valid(graph in graphs()) {
        prop_assert_eq!(validate(&graph), Ok(()));
    }

    #[test]
    fn encoding_and_decoding_is_the_identity(graph in graphs()) {
        let text = encode(&graph);
        let back = decode(&text).map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!(&back, &graph);
        prop_assert_eq!(encode(&back), text);
        prop_assert_eq!(hash(&back), hash(&graph));
    }

    #[test]
    fn layout_of_the_json_does_not_matter(graph in graphs()) {
        let value: serde_json::Value = serde_json::from_str(&encode(&graph)).unwrap();
        prop_assert_eq!(decode(&serde_json::to_string_pretty(&value).unwrap()).unwrap(), graph);
    }

    #[test]
    fn drawing_never_panics_also_of_a_broken_graph(
        mut graph in graphs(),
        node in 0..100_usize,
        to in 0..200_u32,
    ) {
        if let Some(node) = graph.nodes.get_mut(node) {
            node.next = Some(NodeId(to));
            node.region = RegionId(to);
        }
        prop_assert!(!draw::text(&graph).is_empty());
        prop_assert!(!draw::mermaid(&graph).is_empty());
        prop_assert!(!draw::dot(&graph).is_empty());
    }

    #[test]
    fn changed_document_is_refused(
        graph in graphs(),
        at in any::<prop::sample::Index>(),
        byte in b' '..b'~',
    ) {
        let text = encode(&graph);
        let at = at.index(text.len());
        let mut bytes = text.clone().into_bytes();
        bytes[at] = byte;
        let changed = String::from_utf8(bytes).unwrap();
        // Never a panic; and what decodes is the same graph.
        if let Ok(back) = decode(&changed) {
            prop_assert_eq!(back, graph);
        }
    }

    #[test]
    fn no_text_makes_decoding_panic(text in ".{0,200}") {
        prop_assert!(decode(&text).is_err());
    }
}
