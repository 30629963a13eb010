"""The finishes of all assets and scenes: a name, a colour and how the surface takes the light."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Finish:
    """One material.

    Attributes
    ----------
    colour : str
        Hexadecimal sRGB.
    roughness, metallic, transmission, coat, sheen : float
        As in Blender's Principled BSDF, 0 to 1.
    glow : float
        Strength of its own light in its colour.
    pattern : str
        Name of a pattern (:mod:`.materials`) that varies the colour over the surface; empty for none.
    second : str
        The pattern's other colour.
    scale : float
        Size of the pattern's cells in metres.
    """

    colour: str
    roughness: float = 0.6
    metallic: float = 0.0
    transmission: float = 0.0
    coat: float = 0.0
    sheen: float = 0.0
    glow: float = 0.0
    pattern: str = ""
    second: str = ""
    scale: float = 0.1


PALETTE: dict[str, Finish] = {
    # wood, lacquer, metal
    "oak": Finish("#B98A55", 0.5, pattern="grain", second="#A1743F", scale=0.06),
    "walnut": Finish("#6E4630", 0.45, pattern="grain", second="#543222", scale=0.06),
    "birch": Finish("#DCC39A", 0.5, pattern="grain", second="#CDB086", scale=0.06),
    "white lacquer": Finish("#ECEAE4", 0.3, coat=0.3),
    "cream lacquer": Finish("#E2D7C0", 0.35, coat=0.2),
    "sage lacquer": Finish("#8FA38C", 0.4, coat=0.2),
    "grey lacquer": Finish("#8B9095", 0.4),
    "dark lacquer": Finish("#2A2C30", 0.35, coat=0.2),
    "steel": Finish("#C9CCCF", 0.28, metallic=1.0),
    "brass": Finish("#C9A24B", 0.3, metallic=1.0),
    "black metal": Finish("#1D1E20", 0.45, metallic=0.3),
    "plastic": Finish("#3B3E44", 0.5),
    # cloth
    "linen": Finish("#F1EEE7", 0.9, sheen=0.3),
    "pillow": Finish("#FBFAF6", 0.9, sheen=0.3),
    "duvet": Finish("#7D9DBB", 0.9, sheen=0.4),
    "throw": Finish("#33506E", 0.95, sheen=0.4),
    "mattress": Finish("#EDE8DC", 0.9),
    "child duvet": Finish("#E5B567", 0.9, sheen=0.4),
    "sofa cloth": Finish("#5F7F7B", 0.95, sheen=0.5),
    "sofa seat": Finish("#6E908B", 0.95, sheen=0.5),
    "mustard cloth": Finish("#D29B36", 0.95, sheen=0.5),
    "rust cloth": Finish("#B65C3A", 0.95, sheen=0.5),
    "rust seat": Finish("#C66F4B", 0.95, sheen=0.5),
    "charcoal cloth": Finish("#3C4148", 0.95, sheen=0.3),
    "towel": Finish("#88B6B5", 0.95, sheen=0.5),
    "bath mat": Finish("#5E9AA0", 1.0, sheen=0.6),
    "coat red": Finish("#A33A35", 0.9),
    "coat blue": Finish("#324C76", 0.9),
    "coat tan": Finish("#B08D62", 0.9),
    "rug ground": Finish("#B5483B", 1.0, sheen=0.4),
    "rug border": Finish("#2F3F5C", 1.0, sheen=0.4),
    "rug field": Finish("#E3D3B0", 1.0, sheen=0.4),
    # ceramics, glass, screens
    "porcelain": Finish("#F5F6F5", 0.12, coat=0.6),
    "basin shade": Finish("#DFE5E7", 0.15, coat=0.5),
    "glass": Finish("#E9F4F4", 0.02, transmission=0.95),
    "window glass": Finish("#BFDDE6", 0.05, transmission=0.7),
    "daylight": Finish("#DDEBF4", 0.2, glow=1.1),
    "night glass": Finish("#22364A", 0.08, coat=0.8),
    "mirror": Finish("#DDE6EA", 0.03, metallic=1.0),
    "screen": Finish("#0B0D12", 0.12, coat=0.8),
    "screen image": Finish("#3D6E9E", 0.2, glow=0.35),
    "hob": Finish("#141518", 0.12, coat=0.8),
    "hot ring": Finish("#5A5E64", 0.25),
    "lamp shade": Finish("#F6E7C4", 0.8, glow=0.6),
    "worktop": Finish("#5B564F", 0.35, pattern="mottled", second="#6E685F", scale=0.02),
    "wicker": Finish("#B18B58", 0.8, pattern="weave", second="#8D6A3D", scale=0.03),
    "terracotta": Finish("#B5653F", 0.8),
    "soil": Finish("#4A3527", 1.0, pattern="mottled", second="#5D4433", scale=0.08),
    "paper": Finish("#EFE9DC", 0.9),
    "book red": Finish("#9C3B34", 0.7),
    "book blue": Finish("#2F5574", 0.7),
    "book green": Finish("#4E7152", 0.7),
    "book yellow": Finish("#D3A545", 0.7),
    "book grey": Finish("#6B6E73", 0.7),
    "fruit red": Finish("#C23B2C", 0.4),
    "fruit green": Finish("#7FA33A", 0.4),
    # plants
    "leaf": Finish("#3F7A3A", 0.6, pattern="foliage", second="#5C9547"),
    "pale leaf": Finish("#6FA04A", 0.6, pattern="foliage", second="#86B458"),
    "shade leaf": Finish("#1F3F22", 0.9),
    "box leaf": Finish("#3C6B34", 0.7, pattern="foliage", second="#517F3F"),
    "tree leaf": Finish("#4C7F36", 0.65, pattern="foliage", second="#6E9A42"),
    "sunny leaf": Finish("#7DA446", 0.65, pattern="foliage", second="#93B552"),
    "needle": Finish("#2C5739", 0.7, pattern="foliage", second="#3C6A44"),
    "bark": Finish("#5D4534", 0.95, pattern="grain", second="#493527", scale=0.05),
    "petal red": Finish("#D2303A", 0.6, sheen=0.3),
    "petal yellow": Finish("#F2C230", 0.6, sheen=0.3),
    "petal white": Finish("#F7F3EC", 0.6, sheen=0.3),
    "petal violet": Finish("#7A4BB0", 0.6, sheen=0.3),
    "petal pink": Finish("#EC85AE", 0.6, sheen=0.3),
    "petal heart": Finish("#E9A21F", 0.7),
    # stone, water
    "sandstone": Finish("#D9C6A0", 0.85, pattern="mottled", second="#C9B48C", scale=0.3),
    "marble": Finish("#EFECE5", 0.4, coat=0.2, pattern="mottled", second="#DAD6CD", scale=0.25),
    "granite": Finish("#A5A39D", 0.75, pattern="mottled", second="#918F8A", scale=0.08),
    "roof slate": Finish("#5C6A78", 0.6, pattern="courses", second="#4A5763", scale=0.45),
    "copper roof": Finish("#6FA58E", 0.55, pattern="mottled", second="#5D937D", scale=0.6),
    "tile red": Finish("#A8382B", 0.55, coat=0.2),
    "tile green": Finish("#2F6F5B", 0.45, coat=0.3),
    "water": Finish("#4F93A8", 0.06, coat=0.8),
    "spray": Finish("#E8F5FA", 0.1, transmission=0.5),
    "lantern light": Finish("#FFE2A0", 0.5, glow=1.5),
    # floors and walls of the plans
    "parquet": Finish("#C49A66", 0.45, pattern="parquet", second="#AE8350", scale=0.16),
    "dark parquet": Finish("#A2764A", 0.45, pattern="parquet", second="#8D633C", scale=0.16),
    "kitchen tiles": Finish("#D8CDB8", 0.35, pattern="tiles", second="#C3B59B", scale=0.4),
    "bath tiles": Finish("#B9D3D8", 0.25, pattern="tiles", second="#9FBEC5", scale=0.3),
    "toilet tiles": Finish("#C9D6C2", 0.25, pattern="tiles", second="#AFC1A7", scale=0.2),
    "hall stone": Finish("#D9D4CA", 0.4, pattern="tiles", second="#C6C0B4", scale=0.6),
    "closet boards": Finish("#D2B58C", 0.5, pattern="parquet", second="#C0A074", scale=0.16),
    "corridor carpet": Finish("#8A8F98", 0.95),
    "plan": Finish("#D2603A", 0.9),
    "wall": Finish("#F2EFE8", 0.9),
    "wall cut": Finish("#4B4F57", 0.9),
    "facade": Finish("#DCCFB8", 0.9),
    "pavement": Finish("#BDBAB2", 0.9, pattern="mottled", second="#AFACA4", scale=0.8),
    "lawn": Finish("#5F8F3A", 0.95, pattern="lawn", second="#6B9A42", scale=1.5),
    "fine lawn": Finish("#6FA342", 0.95, pattern="lawn", second="#7CAF4C", scale=0.8),
    "meadow": Finish("#557A3A", 1.0, pattern="lawn", second="#648845", scale=4.0),
    "gravel": Finish("#D9C49A", 0.95, pattern="mottled", second="#C9B285", scale=0.5),
    "asphalt": Finish("#4E5054", 0.95, pattern="mottled", second="#585A5E", scale=0.8),
    "kerb": Finish("#CFC9BC", 0.8),
    # facades
    "plaster ochre": Finish("#DDB877", 0.9, pattern="mottled", second="#D6AF6C", scale=0.6),
    "plaster rose": Finish("#D9A596", 0.9, pattern="mottled", second="#D29B8B", scale=0.6),
    "plaster sage": Finish("#B4C09F", 0.9, pattern="mottled", second="#ABB895", scale=0.6),
    "plaster cream": Finish("#EBDDBD", 0.9, pattern="mottled", second="#E4D4B1", scale=0.6),
    "plaster blue": Finish("#A6BBCB", 0.9, pattern="mottled", second="#9CB2C3", scale=0.6),
    "plaster brick": Finish("#BF8C74", 0.9, pattern="mottled", second="#B6826A", scale=0.6),
    "plaster grey": Finish("#C6C2BA", 0.9, pattern="mottled", second="#BDB9B0", scale=0.6),
    "tile brown": Finish("#7B4A36", 0.7, pattern="courses", second="#6B3E2C", scale=0.45),
    "tile orange": Finish("#A66A4C", 0.75, pattern="courses", second="#98603F", scale=0.4),
    "pane": Finish("#2B3A47", 0.06, coat=1.0),
    "shop pane": Finish("#3A4C55", 0.05, coat=1.0, pattern="mottled", second="#5A5A4C", scale=0.5),
    "shutter green": Finish("#3F5F51", 0.5, coat=0.2),
    "door green": Finish("#26423A", 0.35, coat=0.4),
    "awning red": Finish("#A63A34", 0.85, sheen=0.2),
    # the goldsmith's
    "gold": Finish("#E8B647", 0.22, metallic=1.0),
    "brushed gold": Finish("#F0C256", 0.42, metallic=1.0),
    "bright gold": Finish("#F5CF6C", 0.14, metallic=1.0),
    "ruby": Finish("#B00020", 0.04, transmission=0.15, coat=1.0),
    "emerald": Finish("#0A8F4F", 0.04, transmission=0.25, coat=1.0),
    "diamond": Finish("#F4FAFF", 0.02, transmission=0.45, coat=1.0),
    "pearl": Finish("#F4EBE0", 0.2, coat=0.8, sheen=0.6),
    "velvet": Finish("#6B1236", 1.0, sheen=0.25),
    "cloth": Finish("#3A3F4B", 0.9),
}
