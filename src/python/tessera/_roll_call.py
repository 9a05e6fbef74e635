# SPDX-License-Identifier: BSD-3-Clause
"""Whether all ranks have come to a collective function; as tessera/comm/roll_call.hpp in C++."""
from __future__ import annotations

import atexit
import functools
import sys
import time
from typing import Any, Callable, Optional

import numpy as np

from ._errors import UsageError
from ._exchange import Comm, size_of

RANK_TIMEOUT_S = 600.0

_TAG = 31905
_ANSWER_S = 3.0
_BETWEEN_LOOKS_S = 0.001
_FIRST_LOOKS = 10

_sent: list[np.ndarray] = []  # Messages that nobody may receive; MPI reads them until then.


class _Record:
    """Of one communicator: its roll calls, and what the one said that has failed."""

    def __init__(self) -> None:
        self.num_calls = 0
        self.failure: Optional[str] = None


@functools.lru_cache(maxsize=None)
def _key() -> int:
    """Under which MPI keeps the _Record of a communicator."""
    from mpi4py import MPI

    return MPI.Comm.Create_keyval()


def _record_of(comm: Comm) -> _Record:
    record = comm.Get_attr(_key())
    if record is None:
        record = _Record()
        comm.Set_attr(_key(), record)
    return record


def roll_call(comm: Optional[Comm], function: str, timeout_s: float) -> None:
    """Returns when all ranks have called it. Collective.

    If one has not come in time, those that have ask each other who is there; only then there are messages.

    Raises:
        UsageError: It names the missing ranks, which cannot know. A rank that comes later raises one too, and so
            does every later roll call.
    """
    if comm is None or size_of(comm) == 1:
        return
    record = _record_of(comm)
    if record.failure is None:
        record.num_calls += 1
        call = _RollCall(comm, record.num_calls)
        if call.all_come(timeout_s):
            return
        record.failure = call.failure(function)
        atexit.register(_end_without_the_missing, record.failure)
    raise UsageError(record.failure)


def _end_without_the_missing(failure: str) -> None:
    """The missing rank may wait somewhere else for this one: then mpi4py would wait in MPI_Finalize for ever."""
    from mpi4py import MPI

    if not MPI.Is_finalized():
        print("tessera:", failure, file=sys.stderr, flush=True)
        MPI.COMM_WORLD.Abort(1)


class _RollCall:
    def __init__(self, comm: Comm, number: int) -> None:
        self._comm = comm
        self._number = number
        self._there = {comm.rank}
        self._is_late = False
        self._begin = time.monotonic()
        self._barrier: Any = None  # Abandoned if it does not end: MPI cannot cancel it.

    def all_come(self, timeout_s: float) -> bool:
        """Giving up is not final until the others had time to answer: whoever comes before he hears of it comes in
        time, and then the barrier ends on all ranks."""
        for _ in range(_FIRST_LOOKS):  # One may miss a message that lies in the socket already.
            self._listen()
            time.sleep(_BETWEEN_LOOKS_S)
        self._is_late = len(self._there) > 1
        if self._is_late:  # The others leave, so this rank must not enter.
            return False
        self._barrier = self._comm.Ibarrier()
        if self._ends_within(timeout_s, lambda: len(self._there) > 1):
            return True
        self._tell_others()
        return self._ends_within(_ANSWER_S, lambda: False)

    def failure(self, function: str) -> str:
        rank, size = self._comm.rank, self._comm.size
        if self._is_late or len(self._there) == size:
            what = f"rank {rank} of {size} has called it when others no longer waited"
        else:
            missing = [str(other) for other in range(size) if other not in self._there]
            named = ", ".join(missing[:10]) + (f", and {len(missing) - 10} more" if len(missing) > 10 else "")
            what = f"rank {named} of {size} has" if len(missing) == 1 else f"ranks {named} of {size} have"
            what += f" not called it in {time.monotonic() - self._begin:.1f} s"
        return f"{function}: {what}; every rank of the communicator must call it"

    def _ends_within(self, time_s: float, is_enough: Callable[[], bool]) -> bool:
        """Whether the barrier ends before the time is over, or `is_enough` says so."""
        begin = time.monotonic()
        while not self._barrier.Test():
            self._listen()
            if time.monotonic() - begin > time_s or is_enough():
                return False
            time.sleep(_BETWEEN_LOOKS_S)
        return True

    def _listen(self) -> None:
        """Who has given up is there. Earlier calls may have left messages, where the last rank came just in time."""
        from mpi4py import MPI

        status = MPI.Status()
        while self._comm.Iprobe(MPI.ANY_SOURCE, _TAG, status):
            number = np.zeros(1, np.int64)
            self._comm.Recv(number, status.source, _TAG)
            if number[0] == self._number:
                self._there.add(status.source)

    def _tell_others(self) -> None:
        """Those that are missing too, for they may come. Nobody waits for these messages to be received."""
        number = np.array([self._number], np.int64)
        _sent.append(number)
        for to in range(self._comm.size):
            if to != self._comm.rank:
                self._comm.Isend(number, to, _TAG).Free()
