def page(m): return ""
