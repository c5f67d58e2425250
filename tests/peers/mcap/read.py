"""Reads an MCAP file with the reader of the `mcap` package, and checks that it holds a run: python3 read.py run.mcap"""

import json
import sys

from mcap.reader import make_reader

EXPECTED = {
    "/motet/event": "motet.Event",
    "/motet/effect": "motet.Effect",
    "/motet/graph": "motet.Graph",
    "/motet/state": "motet.State",
    "/tf": "foxglove.FrameTransforms",
    "/scene": "foxglove.SceneUpdate",
}


def main(path):
    counts, last = {}, {}
    with open(path, "rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        time = 0
        for schema, channel, message in reader.iter_messages():
            assert schema.encoding == "jsonschema" and channel.message_encoding == "json", channel
            assert EXPECTED[channel.topic] == schema.name, (channel.topic, schema.name)
            assert message.log_time >= time, "messages are in the order of time"
            time = message.log_time
            assert json.loads(schema.data)["type"] == "object", schema.name
            content = json.loads(message.data)
            missing = [key for key in json.loads(schema.data).get("required", []) if key not in content]
            assert not missing, (channel.topic, missing)
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
            last[channel.topic] = content
        summary = reader.get_summary()
        assert summary.statistics.message_count == sum(counts.values())
    assert set(counts) == set(EXPECTED), counts
    assert "finished" in last["/motet/effect"]["effect"], last["/motet/effect"]
    assert last["/tf"]["transforms"][0]["child_frame_id"] == "base"
    assert any(entity["cubes"] for entity in last["/scene"]["entities"])
    print("read with the mcap package:", ", ".join("%s %d" % pair for pair in sorted(counts.items())))


if __name__ == "__main__":
    main(sys.argv[1])
