"""What every piece of a scenario is: a frozen record without unknown keys, that the library can build."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, ClassVar, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationInfo, model_validator
from pydantic_core import PydanticCustomError

from coplanar.errors import CoplanarError, InvalidInput
from coplanar.scenarios.problems import shown


class Part(BaseModel):
    """A record of a scenario: its keys are checked alone, then together by building what they describe."""

    model_config = ConfigDict(extra="forbid", frozen=True, hide_input_in_errors=True)
    keys_of: ClassVar[dict[str, str]] = {}  # the library's names of arguments, where a key is called otherwise

    def build(self) -> Any:
        """The library's thing; it raises what the library raises."""
        return None

    @model_validator(mode="after")
    def _can_be_built(self, _: ValidationInfo) -> Self:
        with told_by_key(self.keys_of):
            self.build()
        return self


@contextmanager
def told_by_key(keys: dict[str, str]) -> Iterator[None]:
    """Errors of the library as errors of the keys that the values came from."""
    try:
        with np.errstate(all="ignore"):
            yield
    except InvalidInput as error:
        said = {"needed": error.needed, "remedy": error.remedy, "name": keys.get(error.name, error.name)}
        raise PydanticCustomError("refused", "needed {needed}", said | {"given": shown(error.given)}) from None
    except (CoplanarError, ArithmeticError) as error:
        said = {"needed": str(error), "remedy": "", "name": "", "given": ""}
        raise PydanticCustomError("refused", "needed {needed}", said) from None
