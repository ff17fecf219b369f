"""Every mistake of a user becomes one line on stderr, without a traceback, and an exit status."""

from __future__ import annotations

import os
import signal
import sys
import threading
from types import FrameType
from typing import Any, NoReturn

import click

from ..errors import ShipCollisionError
from .console import say
from .help import HelpContext

__all__ = ["Commands", "fail"]

_OURS = __name__.partition(".")[0]


def fail(message: str, status: int) -> NoReturn:
    """End the process with a line on stderr and an exit status."""
    say(f"error: {' '.join(message.split())}", err=True)
    sys.exit(status)


def _end(number: int, frame: FrameType | None) -> NoReturn:
    """End the process as a signal asks, but so that unpacked FMUs are removed on the way."""
    del frame
    fail("ended by a signal; nothing is written", 128 + number)


def _describe(error: click.UsageError) -> str:
    """click's message of a wrong option, in the words of all others, or as it is without its full stop."""
    if isinstance(error, click.NoSuchOption):
        from ..ship.loading.messages import suggest_or_list

        given = [] if error.ctx is None else error.ctx.command.get_params(error.ctx)
        options = [name for parameter in given for name in parameter.opts if name.startswith("--")]
        return f"there is no option {error.option_name}:{suggest_or_list(error.option_name, options)}"
    return error.format_message().removesuffix(".")


class Commands(click.Group):
    """A group of commands that ends with one line on every mistake, and suggests names for unknown commands."""

    context_class = HelpContext
    _called = "shipcollision"
    """The command that was called, for errors to which click gives no context."""

    def main(self, *args: Any, **extra: Any) -> Any:
        """click's main, with all errors printed in one form. Exit status 130 after Ctrl-C, 143 after SIGTERM."""
        if threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGTERM, _end)
        try:
            status: Any = super().main(*args, **{**extra, "standalone_mode": False})
        except click.UsageError as error:
            path = error.ctx.command_path if error.ctx is not None else self._called
            fail(f"{_describe(error)} (see `{path} --help`)", error.exit_code)
        except ShipCollisionError as error:
            fail(str(error), error.exit_status)
        except ModuleNotFoundError as error:
            if (error.name or "").startswith(_OURS):
                raise  # a fault of this package, not of the installation
            fail(f"the package {error.name!r} is not installed: run `python -m pip install {error.name}`", 1)
        except (click.Abort, KeyboardInterrupt):
            fail("interrupted; nothing is written", 128 + signal.SIGINT)
        except BrokenPipeError:  # `shipcollision run | head`
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            sys.exit(1)
        sys.exit(status if isinstance(status, int) else 0)

    def add_command(self, cmd: click.Command, name: str | None = None) -> None:
        """click's, for commands whose help is like ours."""
        cmd.context_class = HelpContext
        super().add_command(cmd, name)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """click's look-up, with a suggestion for a misspelt name."""
        names = self.list_commands(ctx)
        if args[0] not in names and not args[0].startswith("-"):
            from ..ship.loading.messages import suggest_or_list

            ctx.fail(f"unknown command {args[0]!r}:{suggest_or_list(args[0], names)}")
        self._called = f"{ctx.command_path} {args[0]}"
        return super().resolve_command(ctx, args)
