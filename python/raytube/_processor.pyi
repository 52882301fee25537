"""Nothing in it: it is imported where the processor has what the package needs, and raises ImportError where not."""
