"""The command that serves the browser app."""

from __future__ import annotations

from typing import Annotated

import typer

from heeltoe.cli.streams import console


def app(
    host: Annotated[str, typer.Option(metavar="ADDRESS", help="Address to listen at.")] = "127.0.0.1",
    port: Annotated[
        int | None,
        typer.Option(metavar="N", min=0, max=65535, help="Port (default: 8642, or a free one if it is taken)."),
    ] = None,
    no_browser: Annotated[bool, typer.Option("--no-browser", help="Print the address and open no browser.")] = False,
    public: Annotated[
        bool, typer.Option("--public", help="Accept other machines that present the printed token.")
    ] = False,
) -> None:
    """Open the app in the browser: move a slider, watch the dam."""
    from heeltoe.app.serve import serve

    words = console()

    def say(address: str) -> None:
        words.print(f"heeltoe app at {address}  (Ctrl-C ends it)", soft_wrap=True, markup=False)

    serve(host, port, public=public, browser=not no_browser, say=say)
