"""One-token changes of C++: where a text can be changed, and into what. Only code counts: no comments, no strings, no
preprocessor lines, no template headers, no static_asserts, no programmer's checks, no members' zeros."""
import dataclasses
import re

# What is blanked before a place is looked for. Order matters: a quote in a comment opens no string.
NOT_CODE = re.compile(
    r'//[^\n]*'
    r'|/\*.*?\*/'
    r'|R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"'
    r'|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'"
    r'|^[ \t]*\#(?:\\\n|[^\n])*',
    re.DOTALL | re.MULTILINE)
# A call whose arguments hold no code of the algorithm.
CHECKS = re.compile(r'\b(?:static_assert|GNOMON_CHECK(?:_OP)?|alignas|__attribute__)\s*\(')
TEMPLATE_HEADER = re.compile(r'\btemplate <')

SWAPS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&", "+": "-", "-": "+",
         "+=": "-=", "-=": "+=", "min": "max", "max": "min", "true": "false", "false": "true"}
# clang-format puts spaces around a binary operator and none inside template brackets, so the spaces tell them apart.
BINARY = re.compile(r'(?<=[\s])(<=|>=|==|!=|&&|\|\||\+=|-=|<|>|\+|-)(?=\s)')
UNARY_MINUS = re.compile(r'(?:(?<=[(\[{,?:=*/+<>-])|(?<=[(\[{,?:=*/+<>-] )|(?<=return ))-(?=[A-Za-z_(0-9.])')
MIN_MAX = re.compile(r'(?<=[a-z]::)(?:min|max)(?=[(<])')
TRUTH = re.compile(r'\b(?:true|false)\b')
NUMBER = re.compile(r"(?<![\w.'])(?:0[xX][0-9A-Fa-f']+|0b[01']+|(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[uUlLzZfF]*(?![\w.])")
SUBSCRIPT = re.compile(r'(?<=[\w)\]])\[([A-Za-z_][\w.]*|[\w.]+\([\w.]*\))\]')


@dataclasses.dataclass(frozen=True, order=True)
class Mutation:
    """Replaces text[start:end] by `new`; kind is one of comparison, logic, sign, constant, index, choice."""
    start: int
    end: int
    new: str
    kind: str


def blank(text, start, end):
    return text[:start] + re.sub(r'[^\n]', ' ', text[start:end]) + text[end:]


def closing(text, opening, pair):
    """The place after the bracket that closes the one at `opening`."""
    depth = 0
    for i in range(opening, len(text)):
        depth += (text[i] == pair[0]) - (text[i] == pair[1])
        if depth == 0:
            return i + 1
    return len(text)


def code_only(text):
    """`text` with all that is no code turned into spaces; as long as before, line by line."""
    for found in list(NOT_CODE.finditer(text)):
        text = blank(text, *found.span())
    for pattern, pair in ((CHECKS, "()"), (TEMPLATE_HEADER, "<>")):
        for found in list(pattern.finditer(text)):
            text = blank(text, found.start(), closing(text, found.end() - 1, pair))
    return text


def type_scopes(code):
    """The ranges of `code` that lie directly in the braces of a struct, class or enum."""
    scopes, stack, last = [], [], 0
    for m in re.finditer(r'[{}]', code):
        if stack and stack[-1]:
            scopes.append((last, m.start()))
        if m.group() == "{":
            head = re.split(r'[;{}]', code[max(0, m.start() - 300):m.start()])[-1]
            stack.append(bool(re.search(r'\b(?:struct|class|enum)\s+\w', head)))
        elif stack:
            stack.pop()
        last = m.end()
    return scopes


def changed_number(word):
    """Another number of the same type: one more for an integer, twice as much for a fraction; 1 for a zero."""
    body = re.match(r"(?:0[xX][0-9A-Fa-f']+|0b[01']+|[\d.']+(?:[eE][+-]?\d+)?)", word).group()
    suffix = word[len(body):]
    plain = body.replace("'", "")
    if plain[:2].lower() in ("0x", "0b"):
        return f"{int(plain, 0) ^ 1:#x}{suffix}"
    if "." in plain or "e" in plain.lower():
        twice = repr(2 * float(plain)) if float(plain) else "1.0"
        return twice + suffix
    return f"{int(plain) + 1}{suffix}"


def kind_of(operator):
    if operator in ("&&", "||"):
        return "logic"
    return "sign" if operator in ("+", "-", "+=", "-=") else "comparison"


def mutations(text):
    """Every one-token change of the C++ in `text`, in order of place."""
    code = code_only(text)
    found = [Mutation(m.start(1), m.end(1), SWAPS[m.group(1)], kind_of(m.group(1))) for m in BINARY.finditer(code)]
    found += [Mutation(m.start(), m.end(), "", "sign") for m in UNARY_MINUS.finditer(code)]
    found += [Mutation(*m.span(), SWAPS[m.group()], "choice") for pattern in (MIN_MAX, TRUTH) for m in pattern.finditer(code)]
    found += [Mutation(*m.span(), changed_number(m.group()), "constant") for m in NUMBER.finditer(code)]
    found += [Mutation(m.start(1), m.end(1), m.group(1) + " + 1", "index") for m in SUBSCRIPT.finditer(code)]
    # A member's zero is what it holds until it is filled in: nobody reads it, and every user would be compiled anew.
    zeros = [m.span(1) for m in re.finditer(r'= (0(?:\.0)?[uUfF]?|false);', code)
             if any(a <= m.start() < b for a, b in type_scopes(code))]
    return sorted(m for m in found if (m.start, m.end) not in zeros)


def applied(text, mutation):
    return text[:mutation.start] + mutation.new + text[mutation.end:]
