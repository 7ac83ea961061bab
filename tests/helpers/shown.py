"""What README and the pages of docs/ show: a command with what it prints, in a comment before the block."""

import re
import shlex

OUTPUT = re.compile(r"<!-- output: (assur .*?) -->\n```text\n(.*?)```", re.DOTALL)


def chosen(lines, part):
    """What `head -n COUNT` or `sed -n FIRST,LASTp` lets through."""
    if not part:
        return lines
    if counted := re.fullmatch(r"head -n (\d+)", part):
        return lines[: int(counted[1])]
    first, last = re.fullmatch(r"sed -n (\d+),(\d+)p", part).groups()
    return lines[int(first) - 1 : int(last)]


def printed(command, capsys):
    """What a command prints, on standard error if nowhere else, or the lines of it that `head` or `sed` let through."""
    from assur.cli.main import main

    command, part = [*re.split(r" \| (?=head|sed)", command), ""][:2]
    main(shlex.split(command)[1:])
    caught = capsys.readouterr()
    lines = chosen((caught.out or caught.err).splitlines(), part)
    return "\n".join(line.rstrip() for line in lines).strip("\n") + "\n"


def rounded(text):
    """Gaps of rounding size are not the same on every processor."""
    return re.sub(r"\d\.\de-1\d", "rounding", text)
