#!/usr/bin/env python3
"""Types a line into an interactive shell, presses Tab, and prints the words that then stand there, each in <>.

usage: type_into_shell.py bash|zsh LINE        (the environment's PATH has `headrace`)
"""

import os
import pty
import re
import select
import sys
import time

PATIENCE = 60.0  # [s] a loaded machine; only a failing test waits so long

SHELLS = {
    "bash": (["bash", "--norc", "--noprofile", "-i"], 'eval "$(headrace completion bash)"\n'),
    "zsh": (["zsh", "-f", "-i"], "bindkey -e; autoload -Uz compinit; compinit -D -u; source <(headrace completion zsh)\n"),
}


def read_until(terminal, pattern):
    """What the shell has put out up to the pattern; fails when it does not come."""
    text, end = "", time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if select.select([terminal], [], [], 0.2)[0]:
            try:
                text += os.read(terminal, 4096).decode(errors="replace")
            except OSError:
                break  # the shell has ended
            if found := re.search(pattern, text):
                return found
    sys.exit(f"no {pattern} in: {text!r}")


def main():
    shell, line = sys.argv[1:]
    command, setup = SHELLS[shell]
    child, terminal = pty.fork()
    if child == 0:
        os.environ["TERM"] = "xterm"
        os.execvp(command[0], command)
    os.write(terminal, (setup + "echo RE''ADY\n").encode())
    read_until(terminal, "READY")
    # Keys after Tab wait in the terminal until the completion is done; Ctrl-A goes to the line's beginning.
    os.write(terminal, (line + "\t\x01" + "printf '<%s>' WO''RDS \x05 '/END'\n").encode())
    words = read_until(terminal, "<WORDS>(<.*>)</END>")
    os.write(terminal, b"exit\n")
    os.close(terminal)
    os.waitpid(child, 0)
    print(words.group(1))


if __name__ == "__main__":
    main()
