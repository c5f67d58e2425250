"""As much of transformers as xgrammar names when it is imported: any name is an empty class, and nothing of it is
called."""


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    return type(name, (), {"__init__": lambda self, *args, **kwargs: None})
