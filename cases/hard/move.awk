# Moves the nodes of a Gmsh 4.1 ASCII mesh: scaled, then turned about the origin, then shifted.
#   awk -v shift=6e6 -f move.awk bars.msh > moved.msh       by (6e6, 6e6)
#   awk -v scale=1e9 -f move.awk bars.msh > large.msh
#   awk -v turn=37 -f move.awk bars.msh > turned.msh        degrees, counter-clockwise
BEGIN {
    CONVFMT = OFMT = "%.17g"
    if (scale == "") scale = 1
    angle = turn * atan2(0, -1) / 180
}
/^\$Nodes/ { inside = 1 }
/^\$EndNodes/ { inside = 0 }
inside && NF == 3 {
    x = scale * $1
    y = scale * $2
    printf "%.17g %.17g 0\n", cos(angle) * x - sin(angle) * y + shift, sin(angle) * x + cos(angle) * y + shift
    next
}
{ print }
