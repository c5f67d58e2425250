"""As much of torch as xgrammar and tvm-ffi name when they are imported: any name is an empty class, and nothing of it is
called."""


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    return type(name, (), {"__init__": lambda self, *args, **kwargs: None})


class cuda:
    @staticmethod
    def is_available():
        return False
