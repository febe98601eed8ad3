"""Names of files that several commands leave."""

#: The tables as a workbook.
WORKBOOK = "workbook.xlsx"
#: VTK files of an elastic dam.
VTK_FILES = ("dam.pvd", "crack.pvd", "dam-*.vtu", "crack-*.vtu")
