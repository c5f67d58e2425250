"""A plugin of pytest: the laws of drivers as a test.

    def test_my_robot_keeps_the_laws(motet_driver_laws):
        motet_driver_laws(MyRobot)

The fixture takes the arguments of `motet.check_driver`. The test fails with each broken law and the messages of its scene.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from .conformance import Conformance

__all__ = ["motet_driver_laws"]


@pytest.fixture(scope="session")
def motet_driver_laws() -> Callable[..., Conformance]:
    """Checks a driver against the laws of drivers, and fails the test if it breaks one."""
    import motet

    def check(*args: object, **kwargs: object) -> Conformance:
        __tracebackhide__ = True
        found = motet.check_driver(*args, **kwargs)  # type: ignore[arg-type]
        if not found.ok:
            pytest.fail(f"the driver breaks {len(found.broken)} laws\n{found}", pytrace=False)
        return found

    return check
