"""XML as a tree whose elements know their lines; no document types, so no entities."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.parsers import expat

from coplanar.errors import CoplanarError
from coplanar.logs.files import refuse

DEEPEST = 50  # elements within elements


@dataclass(slots=True)
class Element:
    """An element: its name, attributes, children, and the line in which it begins."""

    tag: str
    line: int
    attributes: dict[str, str]
    children: list[Element] = field(default_factory=list)

    def all(self, tag: str) -> list[Element]:
        """Its children of that name."""
        return [child for child in self.children if child.tag == tag]

    def first(self, tag: str) -> Element | None:
        """Its first child of that name."""
        return next((child for child in self.children if child.tag == tag), None)


def xml_of(path: Path, data: bytes) -> Element:
    """The tree of a file.

    Raises:
        InvalidValue: Naming the line where it is no XML, has a document type, or is nested without end.
    """
    parser = expat.ParserCreate()
    top = Element("", 0, {})
    open_elements = [top]

    def begins(tag: str, attributes: dict[str, str]) -> None:
        if len(open_elements) > DEEPEST:
            refuse(path, f"line {parser.CurrentLineNumber}", f"<{tag}>", f"at most {DEEPEST} elements within another")
        element = Element(tag, parser.CurrentLineNumber, attributes)
        open_elements[-1].children.append(element)
        open_elements.append(element)

    def ends(_: str) -> None:
        open_elements.pop()

    def has_type(name: str, *_: Any) -> None:
        refuse(path, f"line {parser.CurrentLineNumber}", f"<!DOCTYPE {name}>", "XML without a document type")

    parser.StartElementHandler, parser.EndElementHandler = begins, ends
    parser.StartDoctypeDeclHandler = has_type
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        refuse(path, f"line {error.lineno}", expat.errors.messages.get(error.code, str(error)), "XML")
    except CoplanarError:
        raise
    except (LookupError, ValueError) as error:
        refuse(path, f"line {parser.CurrentLineNumber}", str(error), "XML in a known encoding")
    return top.children[0]
