"""The relationship functions of sections 4.3, 4.7, 4.9 and 5.3: one table, evaluated on elements at points."""
