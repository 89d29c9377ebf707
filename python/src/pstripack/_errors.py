"""Exceptions for nodes without a triangulation."""
from typing import Tuple


class TriangulationError(ValueError):
    """The nodes have no triangulation. ``nodes``: the indices of the nodes in question, counted from 0; may be empty."""

    def __init__(self, message: str, nodes: Tuple[int, ...] = ()) -> None:
        super().__init__(message, nodes)
        self.nodes = nodes

    def __str__(self) -> str:
        return str(self.args[0])


class BadCoordinateError(TriangulationError):
    """``nodes[0]`` is the first node with a coordinate that is not finite, or whose coordinates are all zero."""


class CoincidentNodesError(TriangulationError):
    """Nodes ``nodes[0]`` and ``nodes[1]`` point in the same direction, and so do ``nodes[2]`` and ``nodes[3]``, and so on:
    the first node of each direction, and a later one."""

    coincide = True  #: False: they are within the threshold


class CollinearNodesError(TriangulationError):
    """All nodes lie on one great circle."""
