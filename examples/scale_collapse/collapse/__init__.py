"""The study of scale_collapse: its runs, the curves that they leave and the report on them."""
