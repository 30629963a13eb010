"""Registering modules in a stated order, and unregistering them in the reverse one."""

from collections.abc import Sequence
from importlib import import_module


def register_in_order(package: str, modules: Sequence[str]) -> None:
    """Call `register()` of each module in turn; where one fails, unregister those before it.

    Parameters
    ----------
    package : str
        The package that the names are relative to.
    modules : sequence of str
        Relative names, such as ``".properties"``; what others point to stands before them.

    Raises
    ------
    Exception
        Whatever the failing `register()` raised: Blender shows it, and the add-on can be enabled again.
    """
    registered = []
    for name in modules:
        module = import_module(name, package)
        try:
            module.register()
        except Exception:
            for done in reversed(registered):
                done.unregister()
            raise
        registered.append(module)


def unregister_in_order(package: str, modules: Sequence[str]) -> None:
    """Call `unregister()` of each module, last first.

    Parameters
    ----------
    package : str
        The package that the names are relative to.
    modules : sequence of str
        The names that `register_in_order` was given.
    """
    for name in reversed(modules):
        import_module(name, package).unregister()
