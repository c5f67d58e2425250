"""An open-vocabulary detector (OWLv2) in place of the one by colour: it finds what words describe.

    python -m motet_mujoco.open_vocabulary --model FOLDER --words 'red mug' --words 'apple'

It reads and answers the same lines as `motet_mujoco.detector`. The model is a folder with the files of a
transformers model, such as a copy of `google/owlv2-base-patch16-ensemble`, or a name that transformers finds.
"""

import argparse
import json
import sys

import numpy as np

from .detector import unpack


class OpenVocabulary:
    """OWLv2 with its words."""

    def __init__(self, model, processor, words, threshold=0.1):
        self.model, self.processor, self.words, self.threshold = model, processor, list(words), threshold

    @classmethod
    def load(cls, folder, words, threshold=0.1):
        """Loads a model and its processor from a folder."""
        from transformers import Owlv2ForObjectDetection, Owlv2Processor

        model = Owlv2ForObjectDetection.from_pretrained(folder).eval()
        return cls(model, Owlv2Processor.from_pretrained(folder), words, threshold)

    def detect(self, picture):
        """Detections of the words in a picture, as the driver protocol writes them, the surest first."""
        import torch

        inputs = self.processor(text=[self.words], images=np.array(picture.colour), return_tensors="pt")
        with torch.no_grad():
            outputs = self.model(**inputs)
        # The picture is padded to a square before it is scaled.
        side = max(picture.colour.shape[:2])
        scores = torch.sigmoid(outputs.logits[0])
        best, labels = scores.max(dim=-1)
        found = []
        for at in torch.argsort(best, descending=True).tolist():
            if best[at] < self.threshold:
                break
            cx, cy, wide, high = (float(part) * side for part in outputs.pred_boxes[0][at])
            box = (cx - wide / 2.0, cy - high / 2.0, cx + wide / 2.0, cy + high / 2.0)
            one = place(picture, box)
            if one is not None:
                position, extent = one
                found.append({"label": self.words[int(labels[at])], "id": None,
                              "pose": {"xyz": position, "quaternion": [0.0, 0.0, 0.0, 1.0]}, "extent": extent,
                              "confidence": round(float(best[at]), 3)})
        return found


def place(picture, box):
    """Position and extent of what fills the middle of a box of a picture, by its depth; None where there is none."""
    height, width = picture.depth.shape
    left, top = max(int(box[0]), 0), max(int(box[1]), 0)
    right, bottom = min(int(np.ceil(box[2])), width), min(int(np.ceil(box[3])), height)
    if right - left < 2 or bottom - top < 2:
        return None
    depth = picture.depth[top:bottom, left:right]
    seen = depth > 0.0
    if seen.sum() < 4:
        return None
    rows, columns = depth.shape
    core = depth[rows // 4 : max(rows - rows // 4, rows // 4 + 1), columns // 4 : max(columns - columns // 4, columns // 4 + 1)]
    core = core[core > 0.0]
    if core.size == 0:
        return None
    near = float(np.median(core))
    # The thing is what is about as far as the middle of the box; the rest is behind it.
    mask = seen & (np.abs(depth - near) < 0.1)
    points = picture.points()[top:bottom, left:right][mask]
    low, high = np.percentile(points, [2, 98], axis=0)
    position, extent = (low + high) / 2.0, np.maximum(high - low, 0.005)
    return [round(float(part), 4) for part in position], [round(float(part), 4) for part in extent]


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--model", required=True, help="folder or name of an OWLv2 model")
    parser.add_argument("--words", action="append", required=True, help="what to find; repeatable")
    parser.add_argument("--threshold", type=float, default=0.1, help="least score of a detection")
    args = parser.parse_args(arguments)
    detector = OpenVocabulary.load(args.model, args.words, args.threshold)
    for line in sys.stdin:
        print(json.dumps({"detections": detector.detect(unpack(json.loads(line)))}), flush=True)


if __name__ == "__main__":
    main()
