"""The laws of drivers as a test, run in a session of pytest of its own."""

TESTS = """
import motet

class Good(motet.Driver):
    owns_clock = True

    async def say(self, goal, text):
        await goal.sleep(1.0)

class Bad(Good):
    async def stop(self, goal):
        goal._session.report("ended", {"goal": goal.number, "outcome": {"success": None}})

def test_good(motet_driver_laws):
    assert motet_driver_laws(Good).ok

def test_bad(motet_driver_laws):
    motet_driver_laws(Bad, robot="hsr")
"""


def test_the_fixture_fails_a_driver_that_breaks_a_law(pytester):
    pytester.makepyfile(TESTS)
    done = pytester.runpytest_subprocess("-p", "no:cacheprovider")
    done.assert_outcomes(passed=1, failed=1)
    done.stdout.fnmatch_lines(["*the driver breaks * laws*"])
