# SPDX-License-Identifier: BSD-3-Clause
"""Rows of arrays between ranks. A communicator of None is one process without MPI."""
from __future__ import annotations

import pickle
import time
from typing import Any, Callable, Optional, TypeVar

import numpy as np

from ._errors import TesseraError

Comm = Any  # mpi4py.MPI.Comm; mpi4py is imported only by who has a communicator.
T = TypeVar("T")


def rank_of(comm: Optional[Comm]) -> int:
    return 0 if comm is None else comm.Get_rank()


def size_of(comm: Optional[Comm]) -> int:
    return 1 if comm is None else comm.Get_size()


def total(comm: Optional[Comm], value: int) -> int:
    """Sum over the ranks. Collective."""
    return value if comm is None else comm.allreduce(value)


def ranges(starts: np.ndarray, counts: np.ndarray) -> np.ndarray:
    """start, start + 1, … of each range, one behind the other. Local."""
    ends = np.cumsum(counts)
    return np.arange(ends[-1] if len(ends) else 0) + np.repeat(starts - (ends - counts), counts)


def send(comm: Optional[Comm], to: np.ndarray, *arrays: np.ndarray) -> tuple[np.ndarray, ...]:
    """Sends row i of each array to the rank to[i]. Collective.

    Returns:
        For each received row the rank that it comes from, and the rows of each array: ordered by rank and, of
        one rank, as there.
    """
    if size_of(comm) == 1:
        return (np.zeros(len(to), np.int64), *(array.copy() for array in arrays))
    assert comm is not None
    order = np.argsort(to, kind="stable")
    counts = np.bincount(to, minlength=comm.size)
    coming = np.empty_like(counts)
    comm.Alltoall(counts, coming)
    return (np.repeat(np.arange(comm.size), coming), *(_send_one(comm, a[order], counts, coming) for a in arrays))


def _send_one(comm: Comm, array: np.ndarray, counts: np.ndarray, coming: np.ndarray) -> np.ndarray:
    array = np.ascontiguousarray(array)
    width = int(np.prod(array.shape[1:], dtype=np.int64))
    received = np.empty((int(coming.sum()), *array.shape[1:]), array.dtype)
    comm.Alltoallv([array, counts * width], [received, coming * width])
    return received


def ask(
    comm: Optional[Comm], whom: np.ndarray, question: np.ndarray, answer: Callable[[np.ndarray], np.ndarray]
) -> np.ndarray:
    """Asks rank whom[i] for what `answer` there makes of question[i]. Collective.

    Args:
        answer: From questions to as many rows.
    """
    asker, questions = send(comm, whom, question)
    _, received = send(comm, asker, answer(questions))
    answers = np.empty_like(received)
    answers[np.argsort(whom, kind="stable")] = received
    return answers


def on_root(comm: Optional[Comm], work: Callable[[], T]) -> T:
    """What `work` gives on rank 0, or throws there, on all ranks. Collective."""
    value, error = None, None
    if rank_of(comm) == 0:
        try:
            value = work()
        except Exception as caught:  # Whatever it is, the others wait; a warning may be an error too.
            error = caught
    if comm is not None:
        _wait_quietly(comm)
        value, told = comm.bcast((value, _as_sent(error)))
        error = error or told
    if error is not None:
        raise error
    return value  # type: ignore[return-value]


def _as_sent(error: Optional[Exception]) -> Optional[Exception]:
    """The error as other ranks can get it: if it cannot be sent, its text."""
    try:
        return pickle.loads(pickle.dumps(error))
    except Exception:
        return TesseraError(f"{type(error).__name__}: {error}")


def _wait_quietly(comm: Comm) -> None:
    """Waits for the other ranks without keeping a core busy, as MPI does: rank 0 may run a program."""
    request = comm.Ibarrier()
    while not request.Test():
        time.sleep(0.02)


def all_or_none(comm: Optional[Comm], work: Callable[[], T]) -> T:
    """What `work` gives; if it throws on one rank, all ranks throw what the lowest such rank has. Collective."""
    value, error = None, None
    try:
        value = work()
    except Exception as caught:  # As in on_root().
        error = caught
    errors = [error] if comm is None else comm.allgather(_as_sent(error))
    for one in errors:
        if one is not None:
            raise one
    return value  # type: ignore[return-value]
