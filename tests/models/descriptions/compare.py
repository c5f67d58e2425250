"""Compares two URDFs element by element: names, attributes with their numbers, and texts. Elements in namespaces of others are left out."""

import sys
import xml.etree.ElementTree as tree


def number(word):
    try:
        return round(float(word), 9)
    except ValueError:
        return word


def content(element):
    attributes = {key: tuple(map(number, text.split())) for key, text in element.attrib.items() if not key.startswith("{")}
    return element.tag, attributes, tuple(map(number, (element.text or "").split()))


def differences(one, other, place):
    if content(one) != content(other):
        print("%s: %s, and %s" % (place, content(one), content(other)))
        return 1
    ours, theirs = ([child for child in parent if isinstance(child.tag, str) and not child.tag.startswith("{")] for parent in (one, other))
    if len(ours) != len(theirs):
        print("%s: %d elements, and %d" % (place, len(ours), len(theirs)))
        return 1
    return sum(differences(a, b, "%s/%s %s" % (place, a.tag, a.get("name", ""))) for a, b in zip(ours, theirs))


def main():
    one, other = (tree.parse(path).getroot() for path in sys.argv[1:3])
    found = differences(one, other, "")
    print("%d elements, %d differences" % (len(list(one.iter())), found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
