"""Carries scripts out on a driver whose answers and failures follow from a seed, and prints the calls of each as a line of JSON.

Arguments: `SEED:FILE` for each script. The numbers are those of `python.rs`.
"""

import importlib.util
import json
import sys

from motet import Entity, Failed
from motet.belief import ANY
from motet.driver import Driver
from motet.script import run

MASK = (1 << 64) - 1


def mix(seed, text):
    hash = seed ^ 0xCBF29CE484222325
    for byte in text.encode():
        hash = ((hash ^ byte) * 0x0100000001B3) & MASK
        hash = ((hash << 5) | (hash >> 59)) & MASK
    return hash >> 7


def shown(value):
    """A tagged value as the text syntax writes it."""
    if value == "any":
        return "any"
    (tag, content), = value.items()
    if tag == "list":
        return "[" + ", ".join(shown(item) for item in content) + "]"
    if tag == "text":
        return json.dumps(content, ensure_ascii=False)
    return str(content)


class Seeded(Driver):
    owns_clock = True

    def __init__(self, seed):
        self.seed, self.log = seed, []

    async def perform(self, goal, **args):
        named = ", ".join(f"{name}: {shown(value)}" for name, value in goal.command["args"])
        text = f"{goal.primitive}({named})"
        manner = goal.command.get("manner")
        self.log.append(text if manner is None else f"{text} {manner['speed']}/{manner['acceleration']}")
        dice = mix(self.seed, f"goal {goal.number}")
        await goal.sleep((dice // 128 % 900) / 100.0 + 0.001)
        if dice // 8 % 12 < 4:
            raise Failed("timeout", f"because of {goal.number}" if dice % 2 == 0 else "")
        thing = lambda number: Entity(("mug", "cup", "bowl")[number % 3])  # noqa: E731
        if goal.primitive == "detect":
            return thing(dice)
        if goal.primitive == "detect_all":
            return [thing(number) for number in range(dice % 4)]
        return None

    def observe(self, query):
        (kind, asked), = query.items()
        if kind == "field":
            text = f"{asked['entity']}.{asked['field']}"
        else:
            name = asked.get("fluent") or asked["measure"]
            text = f"{name}({', '.join(shown(arg) for arg in asked['args'])})"
        number = mix(self.seed, text) % 4
        if number == 0:
            return None
        return number % 2 == 0 if kind == "fact" else number / 5.0


def main():
    for index, case in enumerate(sys.argv[1:]):
        seed, path = case.split(":", 1)
        spec = importlib.util.spec_from_file_location(f"case_{index}", path)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        driver = Seeded(int(seed))
        end = run(module.SCRIPT, driver)
        print(json.dumps(driver.log + [f"failed {end.kind}" if end.how == "failed" else end.how]))


main()
