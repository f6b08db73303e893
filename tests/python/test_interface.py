"""Names, types and words of the module: the stub, the docstrings and the module agree."""

import ast
import inspect
import pathlib
import re

import thinwall
from thinwall import _core, results

STUB = ast.parse(pathlib.Path(_core.__file__).with_name("_core.pyi").read_text(encoding="utf-8"))


def stub_arguments(function):
    """Names of a function's arguments, self left out."""
    arguments = function.args
    return [a.arg for a in (*arguments.args, *arguments.kwonlyargs) if a.arg != "self"]


def stub_defaults(function):
    """{name: value} of the arguments that have a default; ... where the stub leaves it to the module."""
    arguments = function.args
    last = arguments.args[len(arguments.args) - len(arguments.defaults) :]
    pairs = [*zip(last, arguments.defaults), *((a, d) for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults) if d)]
    return {argument.arg: ast.literal_eval(value) for argument, value in pairs}


def bound_signatures(doc):
    """The arguments of every overload as pybind11 writes them into the docstring."""
    found = re.findall(r"^(?:\d+\. )?\w+\((.*)\)(?: -> .*)?$", doc, re.MULTILINE)
    return [signature for signature in found if not signature.startswith("*args")]


def bound_defaults(signature):
    """{name: value} of the arguments that have a default; ... of a value that is no literal, as array([1., 0., 0.])."""
    defaults = {}
    for piece in re.split(r", (?=\w+: |\*, )", signature):
        name, equals, value = re.sub(r"^\*, ", "", piece).partition(" = ")
        if equals:
            try:
                defaults[name.partition(":")[0]] = ast.literal_eval(value)
            except (SyntaxError, ValueError):
                defaults[name.partition(":")[0]] = ...
    return defaults


def same_defaults(stub, bound):
    """The same arguments have one, and the same where both tell it; the stub may leave only what is empty or no literal."""
    return set(stub) == set(bound) and all(
        (bound[name] in (..., [])) if value is ... else value == bound[name] for name, value in stub.items()
    )


def bound_arguments(doc):
    """Names of the arguments of every overload."""
    found = []
    for signature in bound_signatures(doc):
        plain = re.sub(r"\[[^][]*\]", "", signature)
        while "[" in plain:
            plain = re.sub(r"\[[^][]*\]", "", plain)
        found.append([name for name in re.findall(r"(\w+): ", plain) if name != "self"])
    return found


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_stub_and_module_have_the_same_names():
    classes = {node.name for node in STUB.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in STUB.body if isinstance(node, ast.FunctionDef)}
    assert public(dir(_core)) == classes | functions


def test_stub_and_module_have_the_same_arguments():
    for node in STUB.body:
        if isinstance(node, ast.FunctionDef):
            assert stub_arguments(node) in bound_arguments(getattr(_core, node.name).__doc__), node.name


def test_stub_and_module_have_the_same_defaults():
    count = 0
    for node in STUB.body:
        bound = getattr(_core, getattr(node, "name", ""), None)
        methods = [m for m in getattr(node, "body", []) if isinstance(m, ast.FunctionDef)] if inspect.isclass(bound) else [node]
        for function in methods:
            if bound is None or not isinstance(function, ast.FunctionDef) or function.decorator_list:
                continue
            doc = getattr(bound, function.name).__doc__ if inspect.isclass(bound) else bound.__doc__
            told = [bound_defaults(signature) for signature in bound_signatures(doc)]
            assert any(same_defaults(stub_defaults(function), each) for each in told), (node.name, function.name, told)
            count += len(stub_defaults(function))
    assert count > 30


def test_defaults_that_differ_are_seen():
    bound = bound_defaults("self: T, size: List[float[3, 1]], layers: int = 1, at: Optional[str] = None, *, K: float = 0.5")
    assert bound == {"layers": 1, "at": None, "K": 0.5}
    stub = ast.parse("def f(self, size, layers=1, at=None, *, K=0.5): ...").body[0]
    assert stub_arguments(stub) == ["size", "layers", "at", "K"] and same_defaults(stub_defaults(stub), bound)
    for wrong in ("layers=2, at=None, *, K=0.5", "layers=1, at=None, *, K", "layers, at, *, K=0.5", "layers=..., at=None, *, K=0.5"):
        other = stub_defaults(ast.parse(f"def f(self, size, {wrong}): ...").body[0])
        assert not same_defaults(other, bound), wrong


def test_stub_and_module_have_the_same_members():
    for node in STUB.body:
        if not isinstance(node, ast.ClassDef) or issubclass(getattr(_core, node.name), Exception):
            continue
        bound = getattr(_core, node.name)
        members = {member.name: member for member in node.body if isinstance(member, ast.FunctionDef)}
        assert public(vars(bound)) == public(members), node.name
        for name, member in members.items():
            if not isinstance(vars(bound)[name], property):
                assert stub_arguments(member) in bound_arguments(getattr(bound, name).__doc__), f"{node.name}.{name}"


def test_all_that_is_bound_is_public():
    assert public(dir(_core)) <= set(thinwall.__all__)
    assert len(set(thinwall.__all__)) == len(thinwall.__all__)


def words(doc):
    """What a docstring says beyond the signature that pybind11 writes."""
    return [line for line in (doc or "").splitlines() if line.strip() and not re.match(r"^(\d+\. )?\w+\(.*\) -> ", line)]


def test_everything_public_says_what_it_is():
    for name in thinwall.__all__:
        thing = getattr(thinwall, name)
        if name != "__version__":
            assert words(thing.__doc__), name
        if inspect.isclass(thing):
            for member, value in vars(thing).items():
                if not member.startswith("_") and (isinstance(value, property) or callable(value)):
                    assert words(value.__doc__), f"{name}.{member}"
    assert words(results.__doc__)


def test_version_is_that_of_the_project():
    project = pathlib.Path(__file__).resolve().parents[2] / "CMakeLists.txt"
    assert f"project(thinwall VERSION {thinwall.__version__} " in project.read_text(encoding="utf-8")
